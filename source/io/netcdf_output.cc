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
    using Axes = std::vector<std::shared_ptr<GDALDimension>>;

    /// File under construction, by GDAL's model of arrays in several
    /// dimensions. Throws ExcUser, naming @p file, if GDAL fails.
    class NetcdfFile
    {
    public:
      NetcdfFile(const std::filesystem::path &part,
                 const std::filesystem::path &file)
        : file_(file)
        , dataset_(required(
            GetGDALDriverManager()
              ->GetDriverByName("netCDF")
              ->CreateMultiDimensional(part.c_str(), nullptr, nullptr)))
        , root_(dataset_->GetRootGroup())
      {}

      /// Add a dimension with the variable of the same name.
      std::shared_ptr<GDALDimension>
      add_axis(const std::string         &name,
               const std::string         &unit,
               const std::vector<double> &values)
      {
        const auto axis =
          required(root_->CreateDimension(name, "", "", values.size()));
        write(*add_variable(name, unit, {axis}), {0}, {values.size()}, values);
        return axis;
      }

      std::shared_ptr<GDALMDArray>
      add_variable(const std::string &name,
                   const std::string &unit,
                   const Axes        &axes)
      {
        const auto variable = required(root_->CreateMDArray(name, axes, type_));
        variable->SetUnit(unit);
        return variable;
      }

      void
      write(GDALMDArray                &variable,
            const std::vector<GUInt64> &start,
            const std::vector<size_t>  &count,
            const std::vector<double>  &values)
      {
        required(variable.Write(
          start.data(), count.data(), nullptr, nullptr, type_, values.data()));
      }

    private:
      template <typename Result>
      Result
      required(Result result) const
      {
        AssertThrow(result, ExcUser(failed_write(file_, CPLGetLastErrorMsg())));
        return result;
      }

      const std::filesystem::path &file_;
      const GDALExtendedDataType   type_ =
        GDALExtendedDataType::Create(GDT_Float64);
      GDALDatasetUniquePtr       dataset_;
      std::shared_ptr<GDALGroup> root_;
    };



    /// Write rows from south to north, against the order of Raster.
    void
    write_blocks(NetcdfFile file, const SurfaceMotion &motion)
    {
      const Raster       &frame      = motion.frame;
      const bool          in_degrees = frame.coordinate_system == wgs_84;
      std::vector<double> x, y, time;
      for (unsigned int i = 0; i < frame.n_columns; ++i)
        x.push_back(frame.x(i));
      for (unsigned int j = frame.n_rows; j-- > 0;)
        y.push_back(frame.y(j));
      for (unsigned int k = 0; k < motion.n_blocks; ++k)
        time.push_back(motion.start_time + k * motion.interval);
      const auto t_axis = file.add_axis("time", "s", time);
      const auto y_axis = in_degrees ? file.add_axis("lat", "degrees_north", y)
                                     : file.add_axis("y", "m", y);
      const auto x_axis = in_degrees ? file.add_axis("lon", "degrees_east", x)
                                     : file.add_axis("x", "m", x);
      const auto dz = file.add_variable("dz", "m", {t_axis, y_axis, x_axis});
      for (unsigned int k = 0; k < motion.n_blocks; ++k)
        {
          std::vector<double> values = motion.change(k);
          for (unsigned int j = 0; j < frame.n_rows; ++j)
            file.write(*dz,
                       {k, frame.n_rows - 1 - j, 0},
                       {1, 1, x.size()},
                       {values.begin() + j * x.size(),
                        values.begin() + (j + 1) * x.size()});
        }
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
    const std::filesystem::path part = file.string() + ".part";
    write_blocks(NetcdfFile(part, file), motion); // closes the file
    std::error_code error;
    if (CPLGetLastErrorType() < CE_Failure)
      std::filesystem::rename(part, file, error);
    AssertThrow(CPLGetLastErrorType() < CE_Failure && !error,
                ExcUser(failed_write(
                  file, error ? error.message() : CPLGetLastErrorMsg())));
  }
} // namespace talus
