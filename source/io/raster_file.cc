// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/raster_file.h>
#include <talus/io/utm_zone.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace talus
{
  using namespace dealii;

  namespace
  {
    void
    check_readable(const std::filesystem::path &file)
    {
      // Devices and pipes are refused: content can be read only once, or has no
      // end, and opening a pipe waits for a writer.
      std::error_code error;
      AssertThrow(std::filesystem::is_regular_file(file, error) &&
                    std::ifstream(file).peek() != EOF,
                  ExcUser("The raster '" + file.string() +
                          "' cannot be read or is empty. Give the path of an "
                          "existing file, from the folder of the parameter "
                          "file."));
    }



    /// Return the coordinate system of a raster whose format has no place for
    /// it, from the file of the same name with the ending .prj, as in a GIS.
    /// Empty if there is none.
    std::string
    system_beside(std::filesystem::path file)
    {
      std::ifstream     in(file.replace_extension(".prj"), std::ios::binary);
      std::string       words(65536, '\0');
      const std::string blanks = " \t\r\n";
      in.read(words.data(), words.size());
      words.resize(in.gcount());
      words.erase(words.find_last_not_of(blanks) + 1);
      words.erase(0, std::min(words.find_first_not_of(blanks), words.size()));
      return words;
    }



    /// Refuse implausible numbers. A number such as 9.97e36 may mark cells
    /// without a datum, without a declaration in the file, and would be taken
    /// for a mountain. Squares of coordinates must not overflow.
    void
    check_magnitudes(const std::filesystem::path &file, const Raster &raster)
    {
      const auto        it = std::find_if(raster.values.begin(),
                                   raster.values.end(),
                                   [](const double height) {
                                     return std::abs(height) > 1e6;
                                   });
      const std::size_t i  = it - raster.values.begin();
      AssertThrow(
        it == raster.values.end(),
        ExcUser(text("The raster '",
                     file.string(),
                     "' has the height ",
                     *it,
                     " m in row ",
                     i / raster.n_columns + 1,
                     ", column ",
                     i % raster.n_columns + 1,
                     ". If the number marks cells without a datum, declare the "
                     "mark in the head of the file: nodata_value ",
                     *it,
                     ".")));
      const double farthest = std::max({std::abs(raster.west),
                                        std::abs(raster.south),
                                        raster.n_columns * raster.dx,
                                        raster.n_rows * raster.dy});
      AssertThrow(farthest <= 1e9,
                  ExcUser(text("The raster '",
                               file.string(),
                               "' reaches to ",
                               farthest,
                               " m, where a map of the Earth in metres was "
                               "expected. Correct its head.")));
    }



    /// Return @p size rounded to one significant digit.
    double
    rounded(const double size)
    {
      const double digit = std::pow(10., std::floor(std::log10(size)));
      return digit * std::round(size / digit);
    }



    /// Return the command that projects a raster to @p map, a code of EPSG,
    /// with the same cell size.
    std::string
    command(const std::filesystem::path &file,
            const Raster                &raster,
            const std::string           &map)
    {
      const MapUnit unit = map_unit(raster.coordinate_system);
      // A degree of latitude is 111 km.
      const double size =
        rounded(unit == MapUnit::metres ? raster.dy : 111e3 * raster.dy);
      return text("gdalwarp ",
                  raster.coordinate_system.empty() ? "-s_srs " + wgs_84 + " "
                                                   : "",
                  "-t_srs ",
                  map,
                  unit == MapUnit::other ? "" : text(" -tr ", size, ' ', size),
                  " -r cubic ",
                  file.string(),
                  " out.tif && gdal_translate -of AAIGrid out.tif out.asc");
    }



    /// Return the UTM zone at the middle of the raster.
    UtmZone
    zone_of(const Raster &raster)
    {
      std::vector<Point<2>> middle = {
        Point<2>(raster.west + 0.5 * raster.n_columns * raster.dx,
                 raster.south + 0.5 * raster.n_rows * raster.dy)};
      if (map_unit(raster.coordinate_system) == MapUnit::other)
        MapTransformation(raster.coordinate_system, wgs_84).transform(middle);
      return utm_zone(middle[0][0], middle[0][1]);
    }
  } // namespace



  Raster
  read_raster(const std::filesystem::path &file)
  {
    check_readable(file);
    Raster raster;
    if (is_esri_grid(file))
      {
        raster                   = read_esri_grid(file);
        raster.coordinate_system = system_beside(file);
      }
    else
      raster = read_gdal_raster(file);
    check_magnitudes(file, raster);
    return raster;
  }



  void
  check_projection(const std::filesystem::path &file,
                   const Raster                &raster,
                   const std::string           &map)
  {
    const MapUnit unit = map_unit(raster.coordinate_system);
    if (map.empty() ? (unit == MapUnit::metres || unit == MapUnit::unknown)
                    : is_built_with_gdal())
      return;
    const UtmZone     zone   = zone_of(raster);
    const std::string target = map.empty() ? zone.epsg_code() : map;
    AssertThrow(
      false,
      ExcUser(
        text("The raster '",
             file.string(),
             unit == MapUnit::other ? "' is not in metres" : "' is in degrees",
             ": its cells are ",
             raster.dx,
             " wide, and it reaches from ",
             raster.west,
             " to ",
             raster.west + raster.n_columns * raster.dx,
             ". A map in metres was expected. ",
             is_built_with_gdal()
               ? "Set `Projection` = " + zone.name() +
                   ", or project the raster yourself: "
               : "Project the raster yourself, and remove a `Projection` "
                 "(this talus was built without GDAL, which the entry "
                 "needs): ",
             command(file, raster, target),
             ".")));
  }
} // namespace talus
