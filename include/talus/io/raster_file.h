// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_raster_file_h
#define talus_io_raster_file_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Return coordinate system and unit of heights of a file that does not state
  /// them, from the file of the same name with the ending .prj, as in a GIS.
  /// Both are empty without a file .prj. Throws ExcUser if the coordinate
  /// system is not understood.
  Raster
  systems_beside(std::filesystem::path file);



  /// Read a raster in any format that GDAL reads; the coordinate system of an
  /// Esri ASCII grid is in the file .prj beside it. Heights are converted to m
  /// from the unit stated by the file; coordinates are as in the file, possibly
  /// degrees. Only the cells of @p part are read. Throws ExcUser with the file
  /// name if the raster cannot be read, or has heights in an unknown unit.
  /// @param has_heights otherwise the values are left in the unit of the file
  Raster
  read_raster(
    const std::filesystem::path &file,
    const RasterPart &part        = [](const Raster &whole) { return whole; },
    bool              has_heights = true);



  /// Throw ExcUser with the zone of UTM in which @p file lies if the raster is
  /// in degrees, or not in metres.
  void
  check_in_metres(const std::filesystem::path &file, const Raster &raster);
} // namespace talus

#endif
