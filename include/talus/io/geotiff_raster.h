// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_geotiff_raster_h
#define talus_io_geotiff_raster_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>
#include <utility>

namespace talus
{
  /// Read a raster from a GeoTIFF: one band of any kind of numbers, whose rows
  /// lie along the axes of the map. Returns the unit of the coordinates, too:
  /// `degrees`, `m`, or empty if the file does not say it. Throws ExcUser if
  /// there is no such raster, if it is turned or has another unit, or if
  /// talus was built without GDAL.
  std::pair<Raster, std::string>
  read_geotiff(const std::filesystem::path &file);

  /// Write one, with its numbers in double precision: every bit comes back.
  /// Throws ExcUser if that fails, or if check_geotiff() would.
  void
  write_geotiff(const std::filesystem::path &file, const Raster &raster);

  /// Throw ExcUser if no GeoTIFF on this map, a Raster::coordinate_system, can
  /// be written: if talus was built without GDAL, or GDAL does not know it.
  void
  check_geotiff(const std::string &coordinate_system);
} // namespace talus

#endif
