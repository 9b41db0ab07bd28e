// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/esri_grid.h>
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
      std::ifstream in(file, std::ios::binary);
      std::string   bytes(8, '\0');
      // Not of a device or a pipe: what is read once is gone, or has no end.
      if (std::filesystem::is_regular_file(file))
        in.read(bytes.data(), bytes.size());
      AssertThrow(in.gcount() > 0,
                  ExcUser("The raster '" + file.string() +
                          "' cannot be read or is empty. Give the path of an "
                          "existing file, from the folder of the parameter "
                          "file."));
      return bytes;
    }



    void
    refuse(const std::filesystem::path &file,
           const std::string           &format,
           const std::string           &command)
    {
      AssertThrow(false,
                  ExcUser(text("The raster '",
                               file.string(),
                               "' is ",
                               format,
                               ", where an Esri ASCII grid or netCDF-4 was "
                               "expected. Convert it with '",
                               command,
                               "'.")));
    }



    /// Coordinates that fit on the globe, in cells of less than 10 km if they
    /// are degrees. A flume may look the same, hence RasterUnits::metres.
    bool
    looks_like_degrees(const Raster &raster)
    {
      const double east  = raster.west + raster.n_columns * raster.dx;
      const double north = raster.south + raster.n_rows * raster.dy;
      const double slack = raster.dx; // half a cell beyond the poles
      return std::abs(raster.west) <= 360. + slack &&
             std::abs(east) <= 360. + slack &&
             std::abs(raster.south) <= 90. + slack &&
             std::abs(north) <= 90. + slack && raster.dx < 0.1 &&
             raster.dy < 0.1;
    }



    /// The number of the coordinate system UTM in WGS 84 at the middle of a
    /// raster in degrees.
    unsigned int
    epsg_of_utm(const Raster &raster)
    {
      double lon = raster.west + 0.5 * raster.n_columns * raster.dx;
      lon -= 360. * std::floor((lon + 180.) / 360.);
      const auto   zone = static_cast<unsigned int>((lon + 180.) / 6.) + 1;
      const double lat  = raster.south + 0.5 * raster.n_rows * raster.dy;
      return (lat < 0. ? 32700 : 32600) + zone;
    }



    /// Lengths in degrees would make a slope of one in a hundred thousand of
    /// each one.
    void
    refuse_degrees(const std::filesystem::path &file, const Raster &raster)
    {
      // A degree of latitude is 111 km; one digit is enough.
      const double size  = 111e3 * raster.dy;
      const double digit = std::pow(10., std::floor(std::log10(size)));
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
                     ". A map in metres was expected. Project it: gdalwarp "
                     "-t_srs EPSG:",
                     epsg_of_utm(raster),
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
  } // namespace



  Raster
  read_raster(const std::filesystem::path &file, const RasterUnits units)
  {
    const std::string bytes = beginning(file);
    if (bytes.compare(0, 3, "CDF") == 0)
      refuse(file, "netCDF-3", "nccopy -k nc4 in.nc out.nc");
    if (bytes.compare(0, 3, std::string("II*")) == 0 ||
        bytes.compare(0, 4, std::string("MM\0*", 4)) == 0)
      refuse(file, "TIFF", "gdal_translate -of AAIGrid in.tif out.asc");

    Raster      raster;
    std::string unit;
    if (bytes == "\211HDF\r\n\032\n")
      std::tie(raster, unit) = read_netcdf_raster(file);
    else
      raster = read_esri_grid(file);
    if (units == RasterUnits::guess &&
        (unit.rfind("degree", 0) == 0 ||
         (unit.empty() && looks_like_degrees(raster))))
      refuse_degrees(file, raster);
    check_magnitudes(file, raster);
    return raster;
  }
} // namespace talus
