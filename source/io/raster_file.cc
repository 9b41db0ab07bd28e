// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/esri_grid.h>
#include <talus/io/geotiff_raster.h>
#include <talus/io/map_projection.h>
#include <talus/io/netcdf_raster.h>
#include <talus/io/raster_file.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// The first bytes, by which formats are known.
    std::string
    beginning(const std::filesystem::path &file)
    {
      std::ifstream   in;
      std::string     bytes(8, '\0');
      std::error_code error;
      // Not of a device or a pipe: what is read once is gone, or has no end, and
      // to open a pipe is to wait for who writes it.
      if (std::filesystem::is_regular_file(file, error))
        {
          in.open(file, std::ios::binary);
          in.read(bytes.data(), bytes.size());
        }
      AssertThrow(in.gcount() > 0,
                  ExcUser("The raster '" + file.string() +
                          "' cannot be read or is empty. Give the path of an "
                          "existing file, from the folder of the parameter "
                          "file."));
      return bytes;
    }



    /// The order of the bytes, and 42, or 43 for files of more than 4 GB.
    bool
    is_tiff(const std::string &bytes)
    {
      const std::string begin = bytes.substr(0, 4);
      for (const char version : {'*', '+'})
        if (begin == std::string({'I', 'I', version, '\0'}) ||
            begin == std::string({'M', 'M', '\0', version}))
          return true;
      return false;
    }



    /// The map of a raster whose format has no place for it: what GIS keep in a
    /// file of the same name that ends with .prj. Empty if there is none.
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



    /// Whether these can be longitudes and latitudes, however large the cells.
    bool
    fits_on_globe(const Raster &raster)
    {
      const double slack = raster.dx; // half a cell beyond the poles
      return std::abs(raster.west) <= 360. + slack &&
             std::abs(raster.west + raster.n_columns * raster.dx) <=
               360. + slack &&
             std::abs(raster.south) <= 90. + slack &&
             std::abs(raster.south + raster.n_rows * raster.dy) <= 90. + slack;
    }



    /// Cells of less than 10 km if they are degrees. A flume may look the same,
    /// hence RasterUnits::metres.
    bool
    looks_like_degrees(const Raster &raster)
    {
      return fits_on_globe(raster) && raster.dx < 0.1 && raster.dy < 0.1;
    }



    /// Lengths in degrees would make a slope of one in a hundred thousand of
    /// each one.
    void
    refuse_degrees(const std::filesystem::path &file, const Raster &raster)
    {
      const double lon  = raster.west + 0.5 * raster.n_columns * raster.dx;
      const double lat  = raster.south + 0.5 * raster.n_rows * raster.dy;
      const auto   zone = utm_zone(lon, lat);
      // A degree of latitude is 111 km; one digit is enough.
      const double size  = 111e3 * raster.dy;
      const double digit = std::pow(10., std::floor(std::log10(size)));
      const auto   entry = text("`Projection` = ", zone.name());
      AssertThrow(
        false,
        ExcUser(text("The raster '",
                     file.string(),
                     "' is in degrees: its cells are ",
                     raster.dx,
                     " wide, and it reaches from ",
                     raster.west,
                     " to ",
                     raster.west + raster.n_columns * raster.dx,
                     ". A map in metres was expected. ",
                     MapProjection::is_available()
                       ? "Set " + entry + ", or project it yourself"
                       : "Project it (this talus was built without PROJ, which "
                         "would do that by the entry " +
                           entry + ")",
                     ": gdalwarp -t_srs EPSG:",
                     zone.epsg(),
                     " -tr ",
                     digit * std::round(size / digit),
                     " ",
                     digit * std::round(size / digit),
                     " -r bilinear ",
                     file.string(),
                     " out.tif && gdal_translate -of AAIGrid out.tif out.asc. "
                     "If it is in metres (a flume), set `Units` = m.")));
    }



    /// A number such as 9.97e36 marks cells without a datum, but not all files
    /// say so, and it would be taken for a mountain. And squares of coordinates
    /// must not overflow.
    void
    check_magnitudes(const std::filesystem::path &file, const Raster &raster)
    {
      const auto        it = std::find_if(raster.values.begin(),
                                   raster.values.end(),
                                   [](const double height) {
                                     return std::abs(height) > 1e6;
                                   });
      const std::size_t i  = it - raster.values.begin();
      AssertThrow(it == raster.values.end(),
                  ExcUser(text("The raster '",
                               file.string(),
                               "' has the height ",
                               *it,
                               " m in row ",
                               i / raster.n_columns + 1,
                               ", column ",
                               i % raster.n_columns + 1,
                               ". If that marks cells without a datum, say so "
                               "in the head of the file: nodata_value ",
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



    void
    refuse_metres(const std::filesystem::path &file,
                  const Raster                &raster,
                  const std::string           &unit)
    {
      AssertThrow(false,
                  ExcUser(text("The raster '",
                               file.string(),
                               "' reaches from ",
                               raster.west,
                               " to ",
                               raster.west + raster.n_columns * raster.dx,
                               " and from ",
                               raster.south,
                               " to ",
                               raster.south + raster.n_rows * raster.dy,
                               unit.empty() ? "" : " in '" + unit + "'",
                               ", which are no longitudes and latitudes in "
                               "degrees, but a `Projection` is set for it. "
                               "Remove that entry.")));
    }
  } // namespace



  Raster
  read_raster(const std::filesystem::path &file, const RasterUnits units)
  {
    const std::string bytes = beginning(file);
    AssertThrow(bytes.compare(0, 3, "CDF") != 0,
                ExcUser(
                  text("The raster '",
                       file.string(),
                       "' is netCDF-3, where an Esri ASCII grid, netCDF-4 "
                       "or GeoTIFF was expected. Convert it with 'nccopy "
                       "-k nc4 in.nc out.nc'.")));
    Raster      raster;
    std::string unit;
    if (bytes == "\211HDF\r\n\032\n")
      std::tie(raster, unit) = read_netcdf_raster(file);
    else if (is_tiff(bytes))
      std::tie(raster, unit) = read_geotiff(file);
    else
      {
        raster                   = read_esri_grid(file);
        raster.coordinate_system = system_beside(file);
        if (raster.coordinate_system.rfind("GEOG", 0) == 0)
          unit = "degrees";
      }
    const bool says_degrees = (unit.rfind("degree", 0) == 0);
    if (units == RasterUnits::guess &&
        (says_degrees || (unit.empty() && looks_like_degrees(raster))))
      refuse_degrees(file, raster);
    check_magnitudes(file, raster);
    if (units == RasterUnits::degrees &&
        (!fits_on_globe(raster) || !(says_degrees || unit.empty())))
      refuse_metres(file, raster, unit);
    return raster;
  }
} // namespace talus
