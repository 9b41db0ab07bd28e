// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_gdal_raster_h
#define talus_io_gdal_raster_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Read a raster in any format that GDAL reads (GeoTIFF, netCDF, Esri ASCII
  /// grid, whose text is checked by check_esri_grid()): one band of
  /// numbers of any type, with rows along the axes of the map. From a file with
  /// several rasters the raster elevation, z or Band1 is read (names of GEBCO
  /// and GMT). Only the cells of @p part are read. Throws ExcUser if there is
  /// no suitable raster.
  Raster
  read_gdal_raster(const std::filesystem::path &file, const RasterPart &part);



  /// Write a GeoTIFF with numbers in double precision, without loss. Throws
  /// ExcUser on failure and for the reasons of check_geotiff().
  void
  write_geotiff(const std::filesystem::path &file, const Raster &raster);



  /// Throw ExcUser if no GeoTIFF on the map @p coordinate_system, a
  /// Raster::coordinate_system, can be written: if GDAL does not know the map.
  void
  check_geotiff(const std::string &coordinate_system);
} // namespace talus

#endif
