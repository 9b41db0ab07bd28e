// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_section_line_h
#define talus_geometry_section_line_h

#include <deal.II/base/point.h>

#include <vector>

namespace talus
{
  /// Point at which a route crosses the line of a section in plan.
  struct SectionCrossing
  {
    double length; ///< along the section, from its first corner, m
    double sine;   ///< sine of the angle between route and section, positive
                   ///< [-]
  };



  /// Return all places, in the order of the route, where a route crosses the
  /// line of a section. The section extends straight beyond both ends. Both
  /// lines are given by at least two corners in the same plan, m; neighbours
  /// differ.
  std::vector<SectionCrossing>
  find_crossings(const std::vector<dealii::Point<2>> &section,
                 const std::vector<dealii::Point<2>> &route);
} // namespace talus

#endif
