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
  /// Box in which cells are halved n_levels times.
  template <int dim>
  struct RefinementBox
  {
    Box<dim>     box;
    unsigned int n_levels;
  };

  /// Parse the parameter 'Grid/Refinement boxes', with corners in
  /// @p coordinates, and return the boxes in the axes of the mesh. Throws
  /// ExcUser if the text has the wrong format, or if a box lies outside of
  /// @p domain.
  template <int dim>
  std::vector<RefinementBox<dim>>
  parse_refinement_boxes(const std::string      &boxes,
                         const Box<dim>         &domain,
                         const PlaceCoordinates &coordinates =
                           PlaceCoordinates(PlanCoordinates::mesh));

  /// Whether the volume of the cell with the given lower corner and size, m,
  /// intersects the box.
  template <int dim>
  bool
  overlap(const RefinementBox<dim> &box,
          const dealii::Point<dim> &lower,
          double                    size);
} // namespace talus

#endif
