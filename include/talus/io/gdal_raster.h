// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_gdal_raster_h
#define talus_io_gdal_raster_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Read a raster of any format that GDAL reads (GeoTIFF, netCDF): one band of
  /// any kind of numbers, whose rows lie along the axes of the map. Of a file
  /// with several rasters the one named elevation, z or Band1 is read, as GEBCO
  /// and GMT name it. Throws ExcUser if there is no such raster, or if talus was
  /// built without GDAL.
  Raster
  read_gdal_raster(const std::filesystem::path &file);



  /// Write a GeoTIFF, with its numbers in double precision: every bit comes
  /// back. Throws ExcUser if that fails, or if check_geotiff() does.
  void
  write_geotiff(const std::filesystem::path &file, const Raster &raster);



  /// Throw ExcUser if no GeoTIFF on the map @p coordinate_system, a
  /// Raster::coordinate_system, can be written: if talus was built without GDAL,
  /// or if GDAL does not know the map.
  void
  check_geotiff(const std::string &coordinate_system);
} // namespace talus

#endif
