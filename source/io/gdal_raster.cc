// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
#include <talus/io/gdal.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/length_unit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>

#include <cpl_vsi.h>
#include <gdal_priv.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Open a file, or a part of a file by GDAL's name for the part.
    GDALDatasetUniquePtr
    open(const std::string &name)
    {
      // GMT names the axes x and y, without further description. The numbers of
      // an Esri ASCII grid are kept in double precision.
      const char *const options[] = {"IGNORE_XY_AXIS_NAME_CHECKS=YES",
                                     "DATATYPE=Float64",
                                     nullptr};
      return GDALDatasetUniquePtr(
        GDALDataset::Open(name.c_str(),
                          GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR,
                          nullptr,
                          options));
    }



    /// Open the text of an Esri ASCII grid, which must outlive the file.
    GDALDatasetUniquePtr
    open_text(std::string &grid)
    {
      const std::string name = "/vsimem/talus.asc";
      VSIFCloseL(VSIFileFromMemBuffer(name.c_str(),
                                      reinterpret_cast<GByte *>(grid.data()),
                                      grid.size(),
                                      FALSE));
      return open(name);
    }



    /// Return whether @p file begins with the byte order mark of UTF-8, as
    /// editors write it.
    bool
    has_byte_order_mark(const std::filesystem::path &file)
    {
      std::string begin(3, ' ');
      std::ifstream(file, std::ios::binary).read(begin.data(), 3);
      return begin == "\xef\xbb\xbf";
    }



    /// Return the coordinate system of a file; empty for an Esri ASCII grid,
    /// see systems_beside(). netCDF may give only the unit of a coordinate, in
    /// an item such as lon#units=degrees_east.
    std::string
    coordinate_system(GDALDataset &file, const bool is_esri_grid)
    {
      if (is_esri_grid)
        return "";
      const std::string words = file.GetProjectionRef();
      if (!words.empty())
        return words;
      for (CSLConstList item = file.GetMetadata(); item && *item; ++item)
        if (std::strstr(*item, "#units=degrees_east") != nullptr)
          return wgs_84;
      return "";
    }



    /// Return whether a file states no unit. GMT writes user_x_unit.
    bool
    is_unstated(const std::string &unit)
    {
      return unit.empty() || unit.rfind("user_", 0) == 0;
    }



    /// Single band of a file.
    class GdalBand
    {
    public:
      explicit GdalBand(const std::filesystem::path &path);

      /// Read size and place, without values.
      Raster
      frame() const;

      /// Read the values of @p part row by row from the north: packed numbers
      /// are unpacked, and cells without a datum become NaN.
      std::vector<double>
      values(const Raster &part) const;

    private:
      void
      check(const bool success, const std::string &words) const
      {
        AssertThrow(success,
                    ExcUser("The raster '" + path_.string() + "' " + words));
      }

      void
      open_part();
      void
      check_axes(const Raster &frame) const;

      const std::filesystem::path path_;
      const QuietGdal             quiet_;
      std::string                 esri_grid_; ///< a text of GeoClaw's as one
      GDALDatasetUniquePtr        file_;
      GDALRasterBand             *band_         = nullptr;
      bool                        is_esri_grid_ = false;
    };



    GdalBand::GdalBand(const std::filesystem::path &path)
      : path_(path)
    {
      GDALAllRegister();
      esri_grid_ = geoclaw_as_esri_grid(path);
      if (!esri_grid_.empty())
        file_ = open_text(esri_grid_);
      else
        file_ = open((has_byte_order_mark(path) ? "/vsisubfile/3," : "") +
                     path.string());
      check(file_ != nullptr,
            text("is no Esri ASCII grid, which begins with ncols or another "
                 "keyword, and GDAL cannot read it (",
                 CPLGetLastErrorMsg(),
                 "). Give another file, or fetch it anew."));
      if (file_->GetRasterCount() == 0)
        open_part();
      check(file_->GetRasterCount() == 1,
            text("has ",
                 file_->GetRasterCount(),
                 " bands, where one band of heights was expected. Extract a "
                 "band: gdal_translate -b 1 IN OUT.tif."));
      band_ = file_->GetRasterBand(1);
      is_esri_grid_ =
        file_->GetDriver() != nullptr &&
        file_->GetDriver()->GetDescription() == std::string("AAIGrid");
      if (is_esri_grid_)
        {
          const auto in =
            esri_grid_.empty()
              ? std::unique_ptr<std::istream>(
                  std::make_unique<std::ifstream>(path, std::ios::binary))
              : std::make_unique<std::istringstream>(esri_grid_);
          check_esri_grid(*in,
                          path.string(),
                          file_->GetRasterXSize(),
                          file_->GetRasterYSize());
        }
      // netCDF's attribute.
      const char *const sense = band_->GetMetadataItem("positive");
      check(sense == nullptr || std::strcmp(sense, "down") != 0,
            "has depths, positive downwards, where heights were expected. Turn "
            "the sign: gdal_calc.py -A IN --calc=-A --outfile=OUT.tif.");
    }



    /// Open the heights among the rasters of the file. The names of the rasters
    /// end with the name of the variable, as in NETCDF:"gebco.nc":elevation.
    void
    GdalBand::open_part()
    {
      char **const list = file_->GetMetadata("SUBDATASETS");
      std::string  names;
      for (int i = 1;
           CSLFetchNameValue(list, text("SUBDATASET_", i, "_NAME").c_str());
           ++i)
        {
          const std::string name =
            CSLFetchNameValue(list, text("SUBDATASET_", i, "_NAME").c_str());
          const std::string variable = name.substr(name.rfind(':') + 1);
          names += (names.empty() ? "" : ", ") + variable;
          if (variable == "elevation" || variable == "z" || variable == "Band1")
            {
              GDALDatasetUniquePtr part = open(name);
              check(part != nullptr,
                    text("cannot be read (", CPLGetLastErrorMsg(), ")."));
              file_ = std::move(part);
              return;
            }
        }
      check(false,
            text("has no raster of heights, but ",
                 names,
                 ", where a single raster, or a raster named elevation, z "
                 "or Band1, was expected. Copy the heights to a separate "
                 "file: gdal_translate 'NETCDF:\"IN.nc\":NAME' OUT.tif."));
    }



    /// Check all coordinates of netCDF axes. GDAL compares only the first, a
    /// middle and the last spacing; the raster would be stretched where a row
    /// is missing. Without a coordinate system GDAL drops the units of axes.
    void
    GdalBand::check_axes(const Raster &frame) const
    {
      const GDALDatasetUniquePtr file(
        GDALDataset::Open(path_.c_str(), GDAL_OF_MULTIDIM_RASTER));
      if (file == nullptr)
        return;
      for (const auto &axis : file->GetRootGroup()->GetDimensions())
        if (axis->GetSize() == frame.n_columns ||
            axis->GetSize() == frame.n_rows)
          {
            const auto values = axis->GetIndexingVariable();
            double     first = 0., step = 0.;
            check(values == nullptr || values->IsRegularlySpaced(first, step),
                  "has coordinates '" + axis->GetName() +
                    "' that are not evenly spaced. Resample the raster by "
                    "gdalwarp, or add the missing rows.");
            const std::string unit =
              values == nullptr || !frame.coordinate_system.empty()
                ? ""
                : values->GetUnit();
            check(is_unstated(unit) || length_of_unit(unit) == 1.,
                  "has coordinates '" + axis->GetName() + "' in '" + unit +
                    "', where metres were expected. Convert the coordinates "
                    "and their attribute units.");
          }
    }



    // GDAL counts from the outer corner, whether the file gives values at
    // centres or at corners.
    Raster
    GdalBand::frame() const
    {
      std::array<double, 6> t{};
      check(file_->GetGeoTransform(t.data()) == CE_None,
            "has no georeference of evenly spaced cells on the map. "
            "Write the raster anew with a georeference: gdal_translate "
            "-a_ullr WEST NORTH EAST SOUTH IN OUT.tif.");
      check(t[1] > 0. && t[5] != 0.,
            text("has cells of ",
                 t[1],
                 " x ",
                 t[5],
                 ", where a positive size was expected. Correct it."));
      check(t[2] == 0. && t[4] == 0.,
            "lies askew on the map, where rows from west to east were "
            "expected. Turn it: gdalwarp IN OUT.tif.");
      Raster result;
      result.coordinate_system = coordinate_system(*file_, is_esri_grid_);
      result.n_columns         = file_->GetRasterXSize();
      result.n_rows            = file_->GetRasterYSize();
      if (!is_unstated(band_->GetUnitType()))
        result.unit = band_->GetUnitType();
      check_axes(result);
      result.dx    = t[1];
      result.dy    = std::abs(t[5]);
      result.west  = t[0];
      result.south = std::min(t[3], t[3] + result.n_rows * t[5]);
      return result;
    }



    std::vector<double>
    GdalBand::values(const Raster &part) const
    {
      const int n = part.n_columns, m = part.n_rows;
      check(double(n) * m < 1e9,
            text("has ",
                 n,
                 " x ",
                 m,
                 " values at the mesh, where up to a thousand millions can be "
                 "read. Cut out the part you need: gdalwarp -te WEST SOUTH "
                 "EAST NORTH IN OUT.tif."));
      std::array<double, 6> t{};
      file_->GetGeoTransform(t.data());
      const double        edge = part.south + (t[5] > 0. ? 0. : m * part.dy);
      const int           x    = std::lround((part.west - t[0]) / t[1]);
      const int           y    = std::lround((edge - t[3]) / t[5]);
      std::vector<double> result(std::size_t(n) * m);
      std::vector<unsigned char> is_known(result.size());
      const auto                 read = [&](GDALRasterBand *const band,
                            void *const           data,
                            const GDALDataType    type) {
        check(
          band->RasterIO(
            GF_Read, x, y, n, m, data, n, m, type, 0, 0, nullptr) == CE_None,
          text("cannot be read (", CPLGetLastErrorMsg(), "). Fetch it anew."));
      };
      read(band_, result.data(), GDT_Float64);
      read(band_->GetMaskBand(), is_known.data(), GDT_Byte);
      const double scale = band_->GetScale(), offset = band_->GetOffset();
      const bool   is_packed = (scale != 1. || offset != 0.);
      int          has_mark  = 0;
      // A file may declare the mark in double and hold it in single precision.
      float mark = band_->GetNoDataValue(&has_mark);
      if (is_esri_grid_ && !has_mark)
        {
          has_mark = 1;
          mark     = -9999.f; // by Esri's definition
        }
      for (std::size_t i = 0; i < result.size(); ++i)
        if (is_known[i] == 0 || (has_mark && float(result[i]) == mark))
          result[i] = std::numeric_limits<double>::quiet_NaN();
        else if (is_packed) // 1 * -0 + 0 is 0, not -0
          result[i] = scale * result[i] + offset;
      if (t[5] > 0.) // from the south
        for (int r = 0; r < m / 2; ++r)
          std::swap_ranges(result.begin() + std::size_t(n) * r,
                           result.begin() + std::size_t(n) * (r + 1),
                           result.begin() + std::size_t(n) * (m - 1 - r));
      return result;
    }
  } // namespace



  Raster
  read_gdal_raster(const std::filesystem::path &file, const RasterPart &part)
  {
    const GdalBand band(file);
    Raster         raster = part(band.frame());
    raster.values         = band.values(raster);
    return raster;
  }
} // namespace talus
