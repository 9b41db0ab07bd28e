// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/terrain/bring_to_map.h>

namespace talus
{
  using namespace dealii;

  void
  bring_to_map(std::vector<Point<2>> &places,
               const std::string     &coordinate_system,
               const std::string     &map,
               const std::string     &file,
               const std::string     &remedy)
  {
    const MapUnit unit = map_unit(coordinate_system);
    AssertThrow(
      !map.empty() || unit == MapUnit::metres || unit == MapUnit::unknown,
      ExcUser(
        text(file,
             unit == MapUnit::degrees ? " is in degrees" : " is not in metres",
             ". Name the map to which the file is to be projected: ",
             remedy,
             ", such as UTM 33N.")));
    if (!map.empty())
      MapTransformation(unit == MapUnit::unknown ? wgs_84 : coordinate_system,
                        map)
        .transform(places);
    for (const Point<2> &place : places)
      AssertThrow(std::isfinite(place.norm()),
                  ExcUser(text(file,
                               " has a corner without a place on the map ",
                               remedy,
                               " = '",
                               map,
                               "'. Choose another map, or remove that entry if "
                               "the file is in metres.")));
  }
} // namespace talus
