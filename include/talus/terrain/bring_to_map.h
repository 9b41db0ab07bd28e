// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_bring_to_map_h
#define talus_terrain_bring_to_map_h

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace talus
{
  /// Transform places of a GIS file to the map of the rasters. Throws ExcUser
  /// if the places are not in metres and there is no map, or if a place has no
  /// counterpart on the map.
  /// @param places as in the file; afterwards easting and northing, m
  /// @param coordinate_system of the places, as Raster::coordinate_system
  /// @param map code of the map, empty if there is none
  /// @param file name of the file for messages, such as "The outline 'a.shp'"
  /// @param remedy entry for the map, such as "'Surfaces/area/Projection'"
  void
  bring_to_map(std::vector<dealii::Point<2>> &places,
               const std::string             &coordinate_system,
               const std::string             &map,
               const std::string             &file,
               const std::string             &remedy);
} // namespace talus

#endif
