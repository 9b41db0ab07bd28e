// SPDX-License-Identifier: LGPL-2.1-or-later
// Replaces the files that need GDAL: every function refuses, with the command
// that converts a file.
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/gdal_features.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/surface_motion.h>

#include <boost/algorithm/string/predicate.hpp>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Throw ExcUser with the finding @p found and the remedy.
    void
    refuse_without_gdal(const std::string &found, const std::string &command)
    {
      AssertThrow(false,
                  ExcUser(found + ", but this talus was built without GDAL. " +
                          command +
                          " Or install Debian's package libgdal-dev, configure "
                          "and build again."));
    }
  } // namespace



  bool
  is_built_with_gdal()
  {
    return false;
  }



  // Well-known text of degrees begins with GEOGCS or GEOGCRS. The words foot
  // and feet are the only units besides metres that surveys use.
  MapUnit
  map_unit(const std::string &coordinate_system)
  {
    for (const std::string unit : {"foot", "feet"})
      if (boost::icontains(coordinate_system, unit))
        return MapUnit::other;
    return coordinate_system == wgs_84 ||
               coordinate_system.rfind("GEOG", 0) == 0
             ? MapUnit::degrees
             : MapUnit::unknown;
  }



  // Names of the registry and well-known text.
  void
  check_understood(const std::string &coordinate_system,
                   const std::string &file)
  {
    if (!coordinate_system.empty() &&
        coordinate_system.find(':') == std::string::npos &&
        coordinate_system.find('[') == std::string::npos)
      refuse_without_gdal(file + " has the coordinate system '" +
                            coordinate_system.substr(0, 60) +
                            "', which is no well-known text",
                          "Write the system as well-known text.");
  }



  double
  strip_vertical_axis(std::string &)
  {
    return 0.;
  }



  std::string
  well_known_text(const std::string &coordinate_system)
  {
    return coordinate_system.rfind("EPSG:", 0) == 0 ? "" : coordinate_system;
  }



  MapTransformation::MapTransformation(const std::string &from,
                                       const std::string &to)
  {
    refuse_without_gdal("Coordinates in '" + from +
                          "' have to be brought to '" + to + "'",
                        "Transform the file yourself, and remove `Projection`: "
                        "ogr2ogr -t_srs " +
                          to + " OUT.geojson IN.");
  }



  void
  MapTransformation::transform(std::vector<Point<2>> &) const
  {}



  Raster
  read_gdal_raster(const std::filesystem::path &file, const RasterPart &)
  {
    refuse_without_gdal("The raster '" + file.string() +
                          "' is no Esri ASCII grid, which begins with ncols or "
                          "another keyword",
                        "Convert it: gdal_translate -of AAIGrid IN OUT.asc; "
                        "before, if it is in degrees, project it: gdalwarp "
                        "-t_srs EPSG:32633 -r cubic IN OUT.tif (the code is "
                        "that of UTM 33N).");
    return {};
  }



  bool
  has_gdal_features(const std::filesystem::path &file)
  {
    for (const std::string end : {".shp", ".gpkg", ".kml"})
      if (file.extension() == end)
        return true;
    return false;
  }



  MapFeatures
  read_gdal_features(const std::filesystem::path &file)
  {
    refuse_without_gdal("The file '" + file.string() + "' is no GeoJSON file",
                        "Convert it: ogr2ogr -t_srs EPSG:32633 OUT.geojson IN "
                        "(the code is that of UTM 33N).");
    return {};
  }



  void
  check_geotiff(const std::string &)
  {
    refuse_without_gdal("'Maps/Write GeoTIFF' is true",
                        "Set it to false, and convert the maps: "
                        "gdal_translate IN.asc OUT.tif.");
  }



  void
  write_geotiff(const std::filesystem::path &, const Raster &raster)
  {
    check_geotiff(raster.coordinate_system);
  }



  void
  check_netcdf()
  {
    refuse_without_gdal("'Tsunami source/Write netCDF' is true",
                        "Set it to false; tsunami-source.tt3 has the same "
                        "numbers.");
  }



  void
  write_netcdf(const std::filesystem::path &, const SurfaceMotion &)
  {
    check_netcdf();
  }
} // namespace talus
