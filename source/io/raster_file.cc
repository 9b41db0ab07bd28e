// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/esri_grid.h>
#include <talus/io/netcdf_raster.h>
#include <talus/io/raster_file.h>

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
      if (!std::filesystem::is_directory(file))
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
    return raster;
  }
} // namespace talus
