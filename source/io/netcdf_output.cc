// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/files.h>
#include <talus/io/gdal.h>
#include <talus/io/surface_motion.h>

#include <gdal_priv.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Dimensions = std::vector<std::shared_ptr<GDALDimension>>;

    /// File under construction, by GDAL's model of arrays in several
    /// dimensions. A step that fails leaves GDAL's error message.
    class NetcdfFile
    {
    public:
      explicit NetcdfFile(const std::filesystem::path &path)
      {
        GDALAllRegister();
        GDALDriver *const driver =
          GetGDALDriverManager()->GetDriverByName("netCDF");
        if (driver != nullptr)
          dataset_.reset(
            driver->CreateMultiDimensional(path.c_str(), nullptr, nullptr));
        if (dataset_ != nullptr)
          root_ = dataset_->GetRootGroup();
      }

      /// Add a dimension with the variable of the same name.
      std::shared_ptr<GDALDimension>
      add_axis(const std::string         &name,
               const std::string         &unit,
               const std::vector<double> &values)
      {
        const auto dimension =
          root_ ? root_->CreateDimension(name, "", "", values.size()) : nullptr;
        if (const auto variable = add_variable(name, unit, {dimension}))
          write(*variable, {0}, {values.size()}, values);
        return dimension;
      }

      std::shared_ptr<GDALMDArray>
      add_variable(const std::string &name,
                   const std::string &unit,
                   const Dimensions  &dimensions)
      {
        for (const auto &dimension : dimensions)
          if (dimension == nullptr)
            return nullptr;
        const auto variable =
          root_->CreateMDArray(name,
                               dimensions,
                               GDALExtendedDataType::Create(GDT_Float64));
        if (variable != nullptr)
          variable->SetUnit(unit);
        return variable;
      }

      static bool
      write(GDALMDArray                &variable,
            const std::vector<GUInt64> &start,
            const std::vector<size_t>  &count,
            const std::vector<double>  &values)
      {
        return variable.Write(start.data(),
                              count.data(),
                              nullptr,
                              nullptr,
                              GDALExtendedDataType::Create(GDT_Float64),
                              values.data());
      }

    private:
      GDALDatasetUniquePtr       dataset_;
      std::shared_ptr<GDALGroup> root_;
    };



    /// Write rows from south to north, against the order of Raster. Return
    /// whether GDAL succeeded.
    bool
    write_blocks(NetcdfFile &file, const SurfaceMotion &motion)
    {
      const Raster       &frame = motion.frame;
      std::vector<double> x, y, time;
      for (unsigned int i = 0; i < frame.n_columns; ++i)
        x.push_back(frame.x(i));
      for (unsigned int j = 0; j < frame.n_rows; ++j)
        y.push_back(frame.y(frame.n_rows - 1 - j));
      for (unsigned int k = 0; k < motion.n_blocks; ++k)
        time.push_back(motion.start_time + k * motion.interval);
      const auto t_axis     = file.add_axis("time", "s", time);
      const bool in_degrees = frame.coordinate_system == wgs_84;
      const auto y_axis     = file.add_axis(in_degrees ? "lat" : "y",
                                        in_degrees ? "degrees_north" : "m",
                                        y);
      const auto x_axis = file.add_axis(in_degrees ? "lon" : "x",
                                        in_degrees ? "degrees_east" : "m",
                                        x);
      const auto variable =
        file.add_variable("dz", "m", {t_axis, y_axis, x_axis});
      if (variable == nullptr)
        return false;
      for (unsigned int k = 0; k < motion.n_blocks; ++k)
        {
          const std::vector<double> from_north = motion.change(k);
          std::vector<double>       values;
          for (unsigned int j = frame.n_rows; j-- > 0;)
            values.insert(values.end(),
                          from_north.begin() + j * frame.n_columns,
                          from_north.begin() + (j + 1) * frame.n_columns);
          if (!file.write(
                *variable, {k, 0, 0}, {1, y.size(), x.size()}, values))
            return false;
        }
      return true;
    }
  } // namespace



  void
  check_netcdf()
  {
    GDALAllRegister();
    AssertThrow(GetGDALDriverManager()->GetDriverByName("netCDF") != nullptr,
                ExcUser("'Tsunami source/Write netCDF' is true, but GDAL was "
                        "built without netCDF. Set it to false; "
                        "tsunami-source.tt3 has the same numbers."));
  }



  // netCDF writes no streams, so the file is complete under another name first.
  void
  write_netcdf(const std::filesystem::path &file, const SurfaceMotion &motion)
  {
    check_netcdf();
    check_not_input(file);
    const QuietGdal             quiet;
    const std::filesystem::path part       = file.string() + ".part";
    bool                        is_written = false;
    {
      NetcdfFile output(part);
      is_written = write_blocks(output, motion);
    } // closes the file
    std::error_code error;
    if (is_written && CPLGetLastErrorType() < CE_Failure)
      std::filesystem::rename(part, file, error);
    AssertThrow(is_written && CPLGetLastErrorType() < CE_Failure && !error,
                ExcUser(failed_write(
                  file, error ? error.message() : CPLGetLastErrorMsg())));
  }
} // namespace talus
