// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_esri_grid_h
#define talus_io_esri_grid_h

#include <talus/base/raster.h>

#include <filesystem>
#include <istream>
#include <string>

namespace talus
{
  /// Check the text of an Esri ASCII grid (.asc) that GDAL reads with
  /// @p n_columns and @p n_rows: lines of a keyword and a number, followed by a
  /// line for each row of values, the northernmost first. Numbers may have a
  /// decimal comma. Throws ExcUser with @p file and line if a keyword is
  /// missing, unknown or repeated, a row is too short or too long, a row is
  /// missing, or an entry is no number.
  void
  check_esri_grid(std::istream      &in,
                  const std::string &file,
                  unsigned int       n_columns,
                  unsigned int       n_rows);



  /// Return GeoClaw's topography of type 3 as the text of an Esri ASCII grid;
  /// empty if @p file is none. GeoClaw writes the number before the keyword,
  /// and takes `xlower`, `ylower` for the centre of the south-western cell.
  std::string
  geoclaw_as_esri_grid(const std::filesystem::path &file);



  /// Return the shortest text that is read as the same number.
  std::string
  shortest(double value);



  /// Write an Esri ASCII grid with enough digits to restore every bit. Throws
  /// ExcUser on failure.
  void
  write_esri_grid(const std::filesystem::path &file, const Raster &raster);
} // namespace talus

#endif
