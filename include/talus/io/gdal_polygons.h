// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_gdal_polygons_h
#define talus_io_gdal_polygons_h

#include <talus/io/map_outline.h>

#include <filesystem>

namespace talus
{
  /// Return whether GDAL reads vectors (points, lines, polygons) from @p file,
  /// and no raster. Without GDAL: whether the file is named as a shapefile, a
  /// GeoPackage or KML.
  bool
  has_gdal_polygons(const std::filesystem::path &file);



  /// Read the polygons of all layers of a file of any format that GDAL reads,
  /// curved edges as many short ones; all in the coordinate system of the last
  /// layer with polygons. Throws ExcUser if the file cannot be read, or if talus
  /// was built without GDAL.
  MapPolygons
  read_gdal_polygons(const std::filesystem::path &file);
} // namespace talus

#endif
