// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_raster_file_h
#define talus_io_raster_file_h

#include <talus/base/raster.h>

#include <filesystem>

namespace talus
{
  /// What the coordinates of a raster are.
  enum class RasterUnits
  {
    guess, ///< by what the file says, and by their size
    metres,
    degrees
  };



  /// Read a raster, an Esri ASCII grid, netCDF-4 or GeoTIFF, whichever it is by
  /// its content; in metres, unless @p units are degrees. Throws ExcUser, naming the
  /// file, if it cannot be read, is of another format, or not in these units: of
  /// one in degrees with the command that projects it.
  Raster
  read_raster(const std::filesystem::path &file,
              RasterUnits                  units = RasterUnits::guess);
} // namespace talus

#endif
