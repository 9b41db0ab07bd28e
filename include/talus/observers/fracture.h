// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_fracture_h
#define talus_observers_fracture_h

#include <talus/base/quantity.h>
#include <talus/contact/ground.h>
#include <talus/state/state.h>

namespace talus
{
  /// Signs of numerical fracture, where the points no longer form a continuum.
  /// Counted on cells of size h (`Grid/Cell size`), see CellLattice; a cell is
  /// occupied if it contains the centre of a point.
  struct FractureCounts
  {
    unsigned long occupied_cells = 0;
    /// Unoccupied cells below an occupied cell of the same column (same x and
    /// z), down to the next occupied cell or to the ground: the bottom face of
    /// the mesh or a cell whose centre lies in an obstacle. Cells down to the
    /// ground count only if the occupied cell belongs to a connected body
    /// resting on the ground: under a hanging body no soil is missing.
    unsigned long empty_interior_cells = 0;
    /// Columns of the mesh without an occupied cell, between the first and the
    /// last occupied column; in 3-D slabs of cells with the same x.
    unsigned long empty_columns = 0;
    /// Groups of occupied cells connected across faces, edges or corners.
    unsigned long connected_bodies = 0;
    /// Cells with exactly one point.
    unsigned long cells_with_one_point = 0;
  };



  /// Count the signs of fracture. The points need not be sorted. The cost grows
  /// with the number of points, not with the size of the mesh. Collective over
  /// the ranks of the grid; the result is valid on the first rank only.
  template <int dim>
  FractureCounts
  count_fractures(const Points<dim> &points,
                  const Grid<dim>   &grid,
                  const Ground<dim> &ground);



  /// Append all counts except occupied_cells. Collective.
  template <int dim>
  void
  list_fractures(const State<dim>  &state,
                 const Ground<dim> &ground,
                 Quantities        &list);
} // namespace talus

#endif
