// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_map_outline_h
#define talus_io_map_outline_h

#include <deal.II/base/point.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// All polygons of a file of GIS: each a list of rings, the outer one first;
  /// each ring a list of corners.
  struct MapPolygons
  {
    using Ring = std::vector<dealii::Point<2>>;

    std::vector<std::vector<Ring>> polygons;
    /// As Raster::coordinate_system.
    std::string coordinate_system;
  };



  /// Area in plan.
  struct MapOutline
  {
    std::vector<dealii::Point<2>> corners; ///< the last one is not the first
    /// As Raster::coordinate_system.
    std::string coordinate_system;
  };



  /// Return whether @p file contains outlines, not a raster: GeoJSON by its name,
  /// other formats by their content (without GDAL by their names).
  bool
  is_outline_file(const std::filesystem::path &file);



  /// Read the one polygon, without holes, of a GeoJSON file or, with GDAL, of
  /// any file of vectors. Throws ExcUser if @p file cannot be read, or contains
  /// no polygon, several polygons, or a hole.
  MapOutline
  read_outline(const std::filesystem::path &file);
} // namespace talus

#endif
