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
    metres
  };



  /// Read a raster in metres, an Esri ASCII grid or netCDF-4, whichever it is by
  /// its content. Throws ExcUser, naming the file, if it cannot be read, is of
  /// another format, or in degrees: then with the command that projects it.
  Raster
  read_raster(const std::filesystem::path &file,
              RasterUnits                  units = RasterUnits::guess);
} // namespace talus

#endif
