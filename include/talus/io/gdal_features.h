// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_gdal_features_h
#define talus_io_gdal_features_h

#include <talus/io/map_outline.h>

#include <filesystem>

namespace talus
{
  /// Return whether GDAL reads vectors (points, lines, polygons) from @p file,
  /// and no raster. Without GDAL: whether the file has the ending of a
  /// shapefile, a GeoPackage or KML.
  bool
  has_gdal_features(const std::filesystem::path &file);



  /// Read the polygons and lines of all layers of a file, in any format that
  /// GDAL reads. Curved edges become many short edges. The coordinate system is
  /// taken from the last layer with a polygon or line. Throws ExcUser if the
  /// file cannot be read, or if talus was built without GDAL.
  MapFeatures
  read_gdal_features(const std::filesystem::path &file);
} // namespace talus

#endif
