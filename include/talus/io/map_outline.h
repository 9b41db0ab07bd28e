// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_map_outline_h
#define talus_io_map_outline_h

#include <deal.II/base/point.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Outlines of areas in plan, or a line.
  struct MapCorners
  {
    /// Corners of each; the first corner of an area is not repeated at the end.
    std::vector<std::vector<dealii::Point<2>>> parts;
    /// A number of each area.
    std::vector<double> numbers;
    /// As Raster::coordinate_system.
    std::string coordinate_system;
  };



  /// Return whether GDAL reads vectors (points, lines, polygons) from @p file,
  /// and no raster.
  bool
  is_outline_file(const std::filesystem::path &file);



  /// Read the polygons of any file of vectors that GDAL reads; with an
  /// @p attribute, a number of each polygon, too. Throws ExcUser if @p file
  /// cannot be read, contains no polygon, a hole, or a polygon without the
  /// number.
  MapCorners
  read_outlines(const std::filesystem::path &file,
                const std::string           &attribute = "");

  /// Read the line of a file, in the formats of read_outline(). Throws ExcUser
  /// if @p file cannot be read, or contains no line or several lines.
  MapCorners
  read_line(const std::filesystem::path &file);
} // namespace talus

#endif
