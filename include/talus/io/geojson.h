// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_geojson_h
#define talus_io_geojson_h

#include <deal.II/base/point.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// The one polygon of a GeoJSON file.
  struct GeojsonPolygon
  {
    std::vector<dealii::Point<2>> corners; ///< the last one is not the first
    /// Whether corners are longitude and latitude in degrees (WGS 84), as the
    /// standard (RFC 7946) has it; else easting and northing in m, of the map
    /// that the member `crs` of the file names.
    bool is_in_degrees;
  };



  /// The one line of a GeoJSON file.
  struct GeojsonLine
  {
    std::vector<dealii::Point<2>> corners;
    bool                          is_in_degrees; ///< as that of GeojsonPolygon
  };



  /// Whether the name of a file says that it is GeoJSON.
  bool
  is_geojson(const std::filesystem::path &path);

  /// Read a polygon without holes. Throws ExcUser if the file cannot be read, or
  /// has none or several.
  GeojsonPolygon
  read_geojson_polygon(const std::filesystem::path &path);

  /// Read a line (LineString). Throws ExcUser if the file cannot be read, or has
  /// none or several.
  GeojsonLine
  read_geojson_line(const std::filesystem::path &path);
} // namespace talus

#endif
