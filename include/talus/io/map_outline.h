// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_map_outline_h
#define talus_io_map_outline_h

#include <deal.II/base/point.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Corners of an area or a line in plan; the first corner of an area is not
  /// repeated at the end.
  struct MapCorners
  {
    std::vector<dealii::Point<2>> corners;
    /// As Raster::coordinate_system.
    std::string coordinate_system;
  };



  /// Return whether GDAL reads vectors (points, lines, polygons) from @p file,
  /// and no raster.
  bool
  is_outline_file(const std::filesystem::path &file);



  /// Read the polygon of any file of vectors that GDAL reads.
  /// Throws ExcUser if @p file cannot be read, or contains no polygon, several
  /// polygons, or a hole.
  MapCorners
  read_outline(const std::filesystem::path &file);

  /// Read the line of a file, in the formats of read_outline(). Throws ExcUser
  /// if @p file cannot be read, or contains no line or several lines.
  MapCorners
  read_line(const std::filesystem::path &file);
} // namespace talus

#endif
