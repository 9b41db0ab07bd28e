// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_corner_list_h
#define talus_geometry_corner_list_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace talus
{
  /// Return the corners of a line or polygon, listed in the parameter @p path
  /// as "a,b; a,b; ...", at most 1e9 m. Throws ExcUser with the name of the
  /// parameter.
  std::vector<dealii::Point<2>>
  parse_corners(const std::string &path, const std::string &list);
} // namespace talus

#endif
