// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/geotiff_raster.h>
#include <talus/version.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>

#if TALUS_WITH_GDAL
#  include <talus/io/quiet_gdal.h>

#  include <gdal.h>
#  include <gdal_frmts.h>
#  include <ogr_srs_api.h>
#endif

namespace talus
{
  using namespace dealii;

#if TALUS_WITH_GDAL
  namespace
  {
    /// Of all that GDAL reads GeoTIFF alone: it also reads HDF5, by another
    /// library of that name than ours.
    class GeotiffFile
    {
    public:
      explicit GeotiffFile(const std::filesystem::path &path);

      /// Size and place.
      Raster
      frame() const;

      std::string
      unit() const;

      /// Row by row from the north, packed numbers as what they stand for, NaN
      /// where there is no datum.
      std::vector<double>
      values(const Raster &frame) const;

    private:
      void
      check(const bool success, const std::string &words) const
      {
        AssertThrow(success,
                    ExcUser("The GeoTIFF '" + path_.string() + "' " + words));
      }

      void
      check_call(const bool success) const
      {
        check(success,
              text("cannot be read (",
                   CPLGetLastErrorMsg(),
                   "). Fetch it anew, or write it as a TIFF of one band, or as "
                   "text: gdal_translate -of AAIGrid in.tif out.asc."));
      }

      using File = std::unique_ptr<std::remove_pointer_t<GDALDatasetH>,
                                   decltype(&GDALClose)>;

      const std::filesystem::path path_;
      const QuietGdal             quiet_;
      File                        file_;
      GDALRasterBandH             band_ = nullptr;
    };



    GeotiffFile::GeotiffFile(const std::filesystem::path &path)
      : path_(path)
      , file_(nullptr, GDALClose)
    {
      GDALRegister_GTiff();
      const char *const drivers[] = {"GTiff", nullptr};
      file_.reset(GDALOpenEx(path.c_str(),
                             GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR,
                             drivers,
                             nullptr,
                             nullptr));
      check_call(file_ != nullptr);
      const int n_bands = GDALGetRasterCount(file_.get());
      check(n_bands == 1,
            text("has ",
                 n_bands,
                 " bands, where one of heights was expected. Take one out: "
                 "gdal_translate -b 1 in.tif out.tif."));
      band_ = GDALGetRasterBand(file_.get(), 1);
    }



    // GDAL counts from the outer corner, whatever a file says its values belong
    // to.
    Raster
    GeotiffFile::frame() const
    {
      std::array<double, 6> t{};
      check(GDALGetGeoTransform(file_.get(), t.data()) == CE_None,
            "does not say where it lies on the map. Write it anew with its "
            "georeference: gdal_translate -a_ullr WEST NORTH EAST SOUTH in.tif "
            "out.tif.");
      check(t[2] == 0. && t[4] == 0. && t[1] > 0. && t[5] != 0.,
            "lies askew on the map, where rows from west to east were "
            "expected. Turn it: gdalwarp in.tif out.tif.");
      Raster result;
      result.coordinate_system = GDALGetProjectionRef(file_.get());
      result.n_columns         = GDALGetRasterXSize(file_.get());
      result.n_rows            = GDALGetRasterYSize(file_.get());
      result.dx                = t[1];
      result.dy                = std::abs(t[5]);
      result.west              = t[0];
      result.south             = std::min(t[3], t[3] + result.n_rows * t[5]);
      check(double(result.n_columns) * result.n_rows < 1e9,
            text("has ",
                 result.n_columns,
                 " x ",
                 result.n_rows,
                 " values, where up to a thousand millions can be read. Cut "
                 "out the part you need: gdalwarp -te WEST SOUTH EAST NORTH."));
      return result;
    }



    std::string
    GeotiffFile::unit() const
    {
      const OGRSpatialReferenceH system = GDALGetSpatialRef(file_.get());
      if (system == nullptr)
        return "";
      if (OSRIsGeographic(system))
        return "degrees";
      check(!OSRIsProjected(system) || OSRGetLinearUnits(system, nullptr) == 1.,
            "is not in metres. Project it: gdalwarp -t_srs EPSG:326.. in.tif "
            "out.tif, with the number of the UTM zone.");
      return OSRIsProjected(system) ? "m" : "";
    }



    std::vector<double>
    GeotiffFile::values(const Raster &frame) const
    {
      const int           n = frame.n_columns, m = frame.n_rows;
      std::vector<double> result(std::size_t(n) * m);
      check_call(
        GDALRasterIO(
          band_, GF_Read, 0, 0, n, m, result.data(), n, m, GDT_Float64, 0, 0) ==
        CE_None);
      int          has_missing = 0;
      const double missing     = GDALGetRasterNoDataValue(band_, &has_missing);
      const double scale       = GDALGetRasterScale(band_, nullptr);
      const double offset      = GDALGetRasterOffset(band_, nullptr);
      const bool   is_packed   = (scale != 1. || offset != 0.);
      for (double &value : result)
        if (has_missing && value == missing)
          value = std::numeric_limits<double>::quiet_NaN();
        else if (is_packed) // else -0 would become 0
          value = scale * value + offset;
      std::array<double, 6> t{};
      GDALGetGeoTransform(file_.get(), t.data());
      if (t[5] > 0.) // from the south
        for (int r = 0; r < m / 2; ++r)
          std::swap_ranges(result.begin() + std::size_t(n) * r,
                           result.begin() + std::size_t(n) * (r + 1),
                           result.begin() + std::size_t(n) * (m - 1 - r));
      return result;
    }
  } // namespace



  std::pair<Raster, std::string>
  read_geotiff(const std::filesystem::path &file)
  {
    const GeotiffFile geotiff(file);
    Raster            raster = geotiff.frame();
    raster.values            = geotiff.values(raster);
    return {raster, geotiff.unit()};
  }

#else

  std::pair<Raster, std::string>
  read_geotiff(const std::filesystem::path &file)
  {
    AssertThrow(false,
                ExcUser("The raster '" + file.string() +
                        "' is a GeoTIFF, which this talus was built without "
                        "GDAL to read. Convert it with 'gdal_translate -of "
                        "AAIGrid in.tif out.asc'."));
    return {};
  }
#endif
} // namespace talus
