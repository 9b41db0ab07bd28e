// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_netcdf_raster_h
#define talus_io_netcdf_raster_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>
#include <utility>

namespace talus
{
  /// Read a raster from a netCDF-4 file, which is HDF5: bathymetry as GEBCO
  /// (`lat`, `lon`, `elevation`) and GMT (`x`, `y`, `z`) write it. Rows may go
  /// north or south, and numbers may be packed (`scale_factor`, `add_offset`);
  /// `_FillValue` and `missing_value` are no data. Values belong to the
  /// coordinates of the file. Returns the unit of the coordinates, too, as the
  /// file says it; empty if it does not. Throws ExcUser if there is no such
  /// raster, several that might be meant, or if its coordinates are not evenly
  /// spaced.
  std::pair<Raster, std::string>
  read_netcdf_raster(const std::filesystem::path &file);
} // namespace talus

#endif
