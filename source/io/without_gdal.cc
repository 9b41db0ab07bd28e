// SPDX-License-Identifier: LGPL-2.1-or-later
// What talus does in place of the files that are compiled with GDAL only: it
// refuses, with the command that converts a file.
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/gdal_polygons.h>
#include <talus/io/gdal_raster.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    const std::string how_to_install =
      " Or install Debian's package libgdal-dev, "
      "configure and build again.";
  } // namespace



  bool
  is_built_with_gdal()
  {
    return false;
  }



  // The first word of well-known text, of two versions, in a file .prj.
  MapUnit
  map_unit(const std::string &coordinate_system)
  {
    return coordinate_system == wgs_84 ||
               coordinate_system.rfind("GEOG", 0) == 0
             ? MapUnit::degrees
             : MapUnit::unknown;
  }



  std::string
  well_known_text(const std::string &coordinate_system)
  {
    return coordinate_system.rfind("EPSG:", 0) == 0 ? "" : coordinate_system;
  }



  struct MapTransformation::Implementation
  {};



  MapTransformation::MapTransformation(const std::string &from,
                                       const std::string &to)
  {
    AssertThrow(false,
                ExcUser(text("Coordinates in '",
                             from.substr(0, 60),
                             "' have to be brought to '",
                             to,
                             "', but this talus was built without GDAL. "
                             "Transform the file yourself: ogr2ogr -t_srs ",
                             to,
                             " OUT.geojson IN, and remove `Projection`.",
                             how_to_install)));
  }



  void
  MapTransformation::transform(std::vector<Point<2>> &) const
  {}



  Raster
  read_gdal_raster(const std::filesystem::path &file)
  {
    AssertThrow(false,
                ExcUser(text("The raster '",
                             file.string(),
                             "' is no Esri ASCII grid, which begins with ncols "
                             "or another keyword, and this talus was built "
                             "without GDAL, which reads other formats. Convert "
                             "it: gdal_translate -of AAIGrid IN OUT.asc, or, "
                             "if it is in degrees, gdalwarp -t_srs EPSG:32633 "
                             "-r cubic IN OUT.tif (the code is that of UTM "
                             "33N) before.",
                             how_to_install)));
    return {};
  }



  bool
  has_gdal_polygons(const std::filesystem::path &file)
  {
    for (const std::string end : {".shp", ".gpkg", ".kml"})
      if (file.extension() == end)
        return true;
    return false;
  }



  MapPolygons
  read_gdal_polygons(const std::filesystem::path &file)
  {
    AssertThrow(false,
                ExcUser(text("The outline '",
                             file.string(),
                             "' is no GeoJSON file, and this talus was built "
                             "without GDAL, which reads other formats. Convert "
                             "it: ogr2ogr -t_srs EPSG:32633 OUT.geojson IN "
                             "(the code is that of UTM 33N).",
                             how_to_install)));
    return {};
  }



  void
  check_geotiff(const std::string &)
  {
    AssertThrow(false,
                ExcUser("'Maps/Write GeoTIFF' is true, but this talus was "
                        "built without GDAL, which writes GeoTIFF. Set it to "
                        "false and convert the maps: gdal_translate IN.asc "
                        "OUT.tif." +
                        how_to_install));
  }



  void
  write_geotiff(const std::filesystem::path &, const Raster &raster)
  {
    check_geotiff(raster.coordinate_system);
  }
} // namespace talus
