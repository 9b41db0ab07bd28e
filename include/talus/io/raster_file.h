// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_raster_file_h
#define talus_io_raster_file_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Read a raster: an Esri ASCII grid, with the coordinate system of the file
  /// .prj beside it, or any format that GDAL reads. Coordinates are as in the
  /// file, possibly degrees. Throws ExcUser with the file name if the raster
  /// cannot be read.
  Raster
  read_raster(const std::filesystem::path &file);



  /// Throw ExcUser with the command to project @p file if talus cannot compute
  /// on the raster: if the raster is not in metres and @p map is empty, or if
  /// the raster has to be projected to @p map (EPSG:32633) and talus was built
  /// without GDAL.
  void
  check_projection(const std::filesystem::path &file,
                   const Raster                &raster,
                   const std::string           &map);
} // namespace talus

#endif
