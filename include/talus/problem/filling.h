// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_filling_h
#define talus_problem_filling_h

#include <talus/geometry/region.h>
#include <talus/grid/grid.h>

#include <array>
#include <vector>

namespace talus
{
  /// Measured memory of a material point in a run, bytes (doc/cluster.md).
  template <int dim>
  constexpr double bytes_per_point = (dim == 2 ? 260. : 530.);

  /// Advice for too many points.
  constexpr const char *fewer_points_advice =
    "Lower 'Points per cell and axis', choose a larger 'Grid/Cell size', or "
    "take "
    "more ranks on more machines.";

  /// Place of a new point, and the lengths of the box, m.
  template <int dim>
  struct NewPoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> length;
  };

  /// Divide @p bounds, a box around @p region, into boxes of at most @p size,
  /// m, along each axis, and return the boxes with a part of the region, found
  /// by Region::part_inside().
  template <int dim>
  std::vector<Box<dim>>
  boxes_with_soil(const Region<dim> &region,
                  const Box<dim>    &bounds,
                  double             size);

  /// Return points at the centres of the boxes, of a lattice with @p n boxes
  /// per cell and axis, whose centres lie in @p region. @p bounds is a box
  /// around the region. Only owned cells are filled; smaller cells have smaller
  /// boxes. Throws ExcUser, on a single rank, before the points exceed the
  /// total memory.
  template <int dim>
  std::vector<NewPoint<dim>>
  filling_by_centres(const Grid<dim>                     &grid,
                     const Region<dim>                   &region,
                     const Box<dim>                      &bounds,
                     const std::array<unsigned int, dim> &n);

  /// Return points with the total volume of @p region: one point for each box
  /// of the lattice with at least a fifth of the volume in the region, at the
  /// centroid of the part inside. Smaller parts are added, with the moments, to
  /// the nearest point in the same cell or a touching cell; without a
  /// neighbour, to the largest point around, if more than five times as large.
  /// No point is then much lighter than the neighbours. Only owned cells are
  /// filled; a point may lie in a cell of another rank. The result is
  /// independent of the number of ranks. Throws as filling_by_centres().
  /// Collective.
  template <int dim>
  std::vector<NewPoint<dim>>
  clipped_filling(const Grid<dim>                     &grid,
                  const Region<dim>                   &region,
                  const Box<dim>                      &bounds,
                  const std::array<unsigned int, dim> &n);
} // namespace talus

#endif
