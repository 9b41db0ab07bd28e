// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
#include <talus/io/gdal_features.h>
#include <talus/io/geojson.h>
#include <talus/io/map_outline.h>
#include <talus/io/raster_file.h>

namespace talus
{
  using namespace dealii;

  bool
  is_outline_file(const std::filesystem::path &file)
  {
    std::error_code error;
    return is_geojson(file) || (std::filesystem::is_regular_file(file, error) &&
                                !is_esri_grid(file) && has_gdal_features(file));
  }



  namespace
  {
    MapFeatures
    read_features(const std::filesystem::path &file)
    {
      MapFeatures found =
        is_geojson(file) ? read_geojson(file) : read_gdal_features(file);
      // GDAL leaves out a system that it does not understand.
      if (found.coordinate_system.empty())
        found.coordinate_system = systems_beside(file).coordinate_system;
      check_understood(found.coordinate_system,
                       "The file '" + file.string() + "'");
      return found;
    }
  } // namespace



  MapOutline
  read_outline(const std::filesystem::path &file)
  {
    const MapFeatures found = read_features(file);
    const std::string name  = "The outline '" + file.string() + "' ";
    AssertThrow(found.polygons.size() == 1,
                ExcUser(text(name,
                             "has ",
                             found.polygons.size(),
                             " polygons, where one was expected. Save one "
                             "outline to a file of its own.")));
    AssertThrow(found.polygons[0].size() == 1,
                ExcUser(
                  text(name,
                       "has a polygon of ",
                       found.polygons[0].size(),
                       " rings, where one was expected: the outline, without "
                       "holes. Remove the holes.")));
    MapOutline outline{found.polygons[0][0], found.coordinate_system};
    if (outline.corners.size() > 1 &&
        outline.corners.front() == outline.corners.back())
      outline.corners.pop_back();
    return outline;
  }



  MapLine
  read_line(const std::filesystem::path &file)
  {
    const MapFeatures found = read_features(file);
    AssertThrow(found.lines.size() == 1,
                ExcUser(text("The route '",
                             file.string(),
                             "' has ",
                             found.lines.size(),
                             " lines, where one was expected. Save one line to "
                             "a file of its own.")));
    return {found.lines[0], found.coordinate_system};
  }
} // namespace talus
