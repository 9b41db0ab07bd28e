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
    double sine;   ///< of the angle between the two, positive [-]
  };



  /// Return all places, in the order of the route, where a route crosses the line
  /// of a section, which goes on straight beyond its ends. Both are given by
  /// their corners in the same plan, m, two at least; neighbours differ.
  std::vector<SectionCrossing>
  find_crossings(const std::vector<dealii::Point<2>> &section,
                 const std::vector<dealii::Point<2>> &route);
} // namespace talus

#endif
