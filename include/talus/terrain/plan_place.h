// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_plan_place_h
#define talus_terrain_plan_place_h

#include <talus/base/place_coordinates.h>

#include <deal.II/base/point.h>

#include <string>

namespace talus
{
  /// Return the place in the axes of the mesh, m, with y = 0, from the text
  /// @p place of the parameter @p entry: 'x' in 2-D, 'x, z' or 'easting,
  /// northing' in 3-D, all in m. @p origin of the mesh on the map. Throws
  /// ExcUser, with the name of the entry, unless @p place lists the expected
  /// numbers.
  template <int dim>
  dealii::Point<dim>
  parse_plan_place(const std::string      &entry,
                   const std::string      &place,
                   PlanCoordinates         coordinates,
                   const dealii::Point<3> &origin);
} // namespace talus

#endif
