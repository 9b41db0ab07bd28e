// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_esri_grid_h
#define talus_io_esri_grid_h

#include <talus/base/raster.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Return whether the first line of @p file has a keyword of an Esri ASCII
  /// grid; false unless the file is regular.
  bool
  is_esri_grid(const std::filesystem::path &file);



  /// Read an Esri ASCII grid (.asc): lines of a keyword and a number, in any
  /// order and case (`ncols`, `nrows`; `xllcorner` or `xllcenter`, likewise for
  /// y; `cellsize`, or `dx` and `dy`; `nodata_value` or `nodata`), followed by
  /// a line for each row of values, the northernmost first. Also read are:
  /// numbers before their keywords, commas or semicolons between numbers,
  /// decimal commas, `nan` as a value or as the mark of missing values. Throws
  /// ExcUser with file and line if a keyword is missing, unknown or repeated, a
  /// row is too short or too long, or an entry is no number. Only the cells of
  /// @p part are stored.
  Raster
  read_esri_grid(const std::filesystem::path &file, const RasterPart &part);



  /// Return the shortest text that is read as the same number.
  std::string
  shortest(double value);



  /// Write an Esri ASCII grid with enough digits to restore every bit. Throws
  /// ExcUser on failure.
  void
  write_esri_grid(const std::filesystem::path &file, const Raster &raster);
} // namespace talus

#endif
