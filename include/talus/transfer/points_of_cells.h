// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_points_of_cells_h
#define talus_transfer_points_of_cells_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <vector>

namespace talus
{
  /// Attach to each owned cell its weight [-] and its points, as deal.II's data
  /// of variable size: they go where p4est sends the cell, to another rank by
  /// Grid::repartition() or into a file by Grid::save(). Return the handle for
  /// points_of_cells().
  ///
  /// @param points sorted
  /// @param weights at least 1, in the order of the cells
  template <int dim>
  unsigned int
  attach_points(Grid<dim>                 &grid,
                const Points<dim>         &points,
                const std::vector<double> &weights);



  /// Take what attach_points() attached. Call after Grid::prepare().
  ///
  /// @param handle of attach_points()
  /// @param points replaced by the points of the cells, in their order within
  ///   a cell, which is part of the state; unsorted
  /// @param weights replaced by the weights of the cells
  /// @return cell of each point
  template <int dim>
  std::vector<unsigned int>
  points_of_cells(Grid<dim>           &grid,
                  const unsigned int   handle,
                  Points<dim>         &points,
                  std::vector<double> &weights);



  /// Take the points and weights of the cells of a loaded mesh, after
  /// Grid::load() and Grid::prepare(), as points_of_cells() does.
  template <int dim>
  std::vector<unsigned int>
  load_points(Grid<dim>           &grid,
              Points<dim>         &points,
              std::vector<double> &weights)
  {
    // deal.II hands out loaded data to functions that attach data again.
    return points_of_cells(grid,
                           attach_points(grid, points, weights),
                           points,
                           weights);
  }
} // namespace talus

#endif
