// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_filling_h
#define talus_problem_filling_h

#include <talus/geometry/region.h>
#include <talus/grid/grid.h>

#include <array>
#include <vector>

namespace talus
{
  /// What a material point takes in a run, bytes, as it was measured
  /// (doc/cluster.md).
  template <int dim>
  constexpr double bytes_per_point = (dim == 2 ? 260. : 530.);

  /// What to do where points would take too much.
  constexpr const char *fewer_points_advice =
    "Lower 'Points per cell and axis', choose a larger 'Grid/Cell size', or "
    "take "
    "more ranks on more machines.";

  /// A point that is to be made, and the lengths of its box, m.
  template <int dim>
  struct NewPoint
  {
    dealii::Point<dim>     x;
    dealii::Tensor<1, dim> length;
  };

  /// Points at the centres of those boxes of the lattice of @p n per cell and
  /// axis whose centre lies in @p region, which lies in @p bounds. For the
  /// owned cells, in smaller cells there are smaller boxes. Throws ExcUser, on
  /// one rank alone, before its points take more than all memory.
  template <int dim>
  std::vector<NewPoint<dim>>
  filling_by_centres(const Grid<dim>                     &grid,
                     const Region<dim>                   &region,
                     const Box<dim>                      &bounds,
                     const std::array<unsigned int, dim> &n);

  /// Points whose volumes add up to that of @p region: one for each box of the
  /// lattice of which at least a fifth lies in the region, at the centroid of
  /// that part. What lies in other boxes is added to the nearest of these
  /// points, in the same cell or one that touches it, with its moments; without
  /// such a neighbour to the largest point around, if that is more than five
  /// times as large, so that no point is much lighter than those around it. For
  /// the owned cells; a point may come to lie in a cell of somebody else. Does
  /// not depend on the ranks. Throws as filling_by_centres(). Collective.
  template <int dim>
  std::vector<NewPoint<dim>>
  clipped_filling(const Grid<dim>                     &grid,
                  const Region<dim>                   &region,
                  const Box<dim>                      &bounds,
                  const std::array<unsigned int, dim> &n);
} // namespace talus

#endif
