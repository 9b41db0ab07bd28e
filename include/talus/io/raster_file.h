// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_raster_file_h
#define talus_io_raster_file_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Read a raster: an Esri ASCII grid, with the coordinate system of the file
  /// .prj beside it, or any format that GDAL reads; in the coordinates of the
  /// file, which may be degrees. Throws ExcUser, naming the file, if it cannot be
  /// read.
  Raster
  read_raster(const std::filesystem::path &file);



  /// Throw ExcUser, with the command that projects @p file, if talus cannot
  /// compute on this raster: if it is not in metres and @p map is empty, or if
  /// it has to be brought to @p map (EPSG:32633) and talus was built without
  /// GDAL.
  void
  check_projection(const std::filesystem::path &file,
                   const Raster                &raster,
                   const std::string           &map);
} // namespace talus

#endif
