// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_surface_motion_h
#define talus_io_surface_motion_h

#include <talus/base/raster.h>

#include <filesystem>
#include <functional>
#include <vector>

namespace talus
{
  /// Change of the height of the sea floor in time, on a raster: the source of
  /// a tsunami model.
  struct SurfaceMotion
  {
    Raster       frame;          ///< cells, without values
    double       start_time = 0; ///< time of the first block, s
    double       interval   = 1; ///< time between two blocks, s
    unsigned int n_blocks   = 0;
    /// Return the change since the start, m, of a block; cells as in Raster.
    std::function<std::vector<double>(unsigned int)> change;
  };



  /// Write the motion as GeoClaw's dtopo file of type 3: nine lines of header,
  /// then a row of numbers for each row of each block, the northernmost row
  /// first. Numbers belong to the centres of the cells. Throws ExcUser if the
  /// file cannot be written.
  void
  write_dtopo(const std::filesystem::path &file, const SurfaceMotion &motion);



  /// Write the motion as netCDF-4 with the variables x, y [m], time [s] and
  /// dz(time, y, x) [m]; y increases. A raster in WGS 84 has lon and lat
  /// [degrees] in place of x and y. Throws ExcUser if the file cannot be
  /// written, and for the reasons of check_netcdf().
  void
  write_netcdf(const std::filesystem::path &file, const SurfaceMotion &motion);



  /// Throw ExcUser if GDAL does not write netCDF.
  void
  check_netcdf();
} // namespace talus

#endif
