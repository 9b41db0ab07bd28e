// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_geojson_h
#define talus_io_geojson_h

#include <talus/io/map_outline.h>

#include <filesystem>

namespace talus
{
  /// Return whether the name of a file is a name of GeoJSON.
  bool
  is_geojson(const std::filesystem::path &path);



  /// Read all polygons and lines of a GeoJSON file, in longitude and latitude
  /// (WGS 84, RFC 7946), or in the coordinate system of the member `crs` of the
  /// file. Throws ExcUser if the file cannot be read.
  MapFeatures
  read_geojson(const std::filesystem::path &path);
} // namespace talus

#endif
