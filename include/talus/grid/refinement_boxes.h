// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_refinement_boxes_h
#define talus_grid_refinement_boxes_h

#include <talus/base/box.h>
#include <talus/base/place_coordinates.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace talus
{
  /// A box in which cells are halved some times.
  template <int dim>
  struct RefinementBox
  {
    Box<dim>     box;
    unsigned int n_levels;
  };

  /// The boxes that the parameter 'Grid/Refinement boxes' names, in the axes of
  /// the mesh. Throws ExcUser if it cannot be read, or if a box lies outside of
  /// @p domain. @p coordinates are those that the corners are given in.
  template <int dim>
  std::vector<RefinementBox<dim>>
  parse_refinement_boxes(const std::string      &boxes,
                         const Box<dim>         &domain,
                         const PlaceCoordinates &coordinates =
                           PlaceCoordinates(PlanCoordinates::mesh));

  /// Whether the cell with this lower corner and size, m, has its volume, or
  /// some of it, in the box.
  template <int dim>
  bool
  overlap(const RefinementBox<dim> &box,
          const dealii::Point<dim> &lower,
          double                    size);
} // namespace talus

#endif
