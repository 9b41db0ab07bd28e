// SPDX-License-Identifier: LGPL-2.1-or-later
// netCDF-4, which is HDF5 by another library than ours: the plane z = a x + b y
// comes back from files as GMT and GEBCO name and store their numbers, and what
// is no raster of heights is refused.

#include <talus/version.h>

#if TALUS_WITH_GDAL
#  include <talus/base/errors.h>
#  include <talus/io/coordinate_system.h>
#  include <talus/io/raster_file.h>

#  include <gtest/gtest.h>

#  include <cmath>
#  include <filesystem>
#  include <functional>

#  include <gdal_priv.h>
#  include <unistd.h>

#  include "core_setup.h"

using namespace talus;
namespace fs = std::filesystem;

// A namespace of its own: several files are compiled as one.
namespace netcdf_test
{
  namespace
  {
    double
    plane(const double x, const double y)
    {
      return 0.125 * x - 0.5 * y;
    }



    using Function = std::function<double(double, double)>;

    /// Writes arrays over two coordinates, the second of which has rows.
    class NetcdfWriter
    {
    public:
      NetcdfWriter(const fs::path            &path,
                   const std::string         &x_name,
                   const std::vector<double> &x,
                   const std::string         &y_name,
                   const std::vector<double> &y)
        : x_(x)
        , y_(y)
      {
        GDALAllRegister();
        file_.reset(GetGDALDriverManager()
                      ->GetDriverByName("netCDF")
                      ->CreateMultiDimensional(path.c_str(), nullptr, nullptr));
        axes_ = {add_axis(y_name, y, "degrees_north"),
                 add_axis(x_name, x, "degrees_east")};
      }

      std::shared_ptr<GDALMDArray>
      add(const std::string &name,
          const GDALDataType type,
          const Function    &value,
          const double       scale  = 1.,
          const double       offset = 0.)
      {
        auto array = root()->CreateMDArray(name,
                                           axes_,
                                           GDALExtendedDataType::Create(type));
        if (scale != 1.)
          {
            array->SetScale(scale);
            array->SetOffset(offset);
          }
        array->SetNoDataValue(-32767.);
        std::vector<double> values;
        for (const double y : y_)
          for (const double x : x_)
            values.push_back((value(x, y) - offset) / scale);
        write(*array, values);
        return array;
      }

    private:
      std::shared_ptr<GDALGroup>
      root() const
      {
        return file_->GetRootGroup();
      }

      static void
      write(GDALMDArray &array, const std::vector<double> &values)
      {
        const std::vector<GUInt64> start(array.GetDimensionCount(), 0);
        std::vector<std::size_t>   counts;
        for (const auto &axis : array.GetDimensions())
          counts.push_back(axis->GetSize());
        ASSERT_TRUE(array.Write(start.data(),
                                counts.data(),
                                nullptr,
                                nullptr,
                                GDALExtendedDataType::Create(GDT_Float64),
                                values.data()));
      }

      /// A coordinate in degrees has a name that says so.
      std::shared_ptr<GDALDimension>
      add_axis(const std::string         &name,
               const std::vector<double> &values,
               const std::string         &unit)
      {
        auto axis = root()->CreateDimension(name, "", "", values.size());
        auto array =
          root()->CreateMDArray(name,
                                {axis},
                                GDALExtendedDataType::Create(GDT_Float64));
        if (name.rfind("l", 0) == 0)
          array->SetUnit(unit);
        write(*array, values);
        return axis;
      }

      GDALDatasetUniquePtr                        file_;
      const std::vector<double>                   x_, y_;
      std::vector<std::shared_ptr<GDALDimension>> axes_;
    };



    class NetcdfTest : public testing::Test
    {
    protected:
      NetcdfTest()
        : path(fs::temp_directory_path() /
               ("talus-netcdf-" + std::to_string(getpid()) + ".nc"))
      {}

      ~NetcdfTest() override
      {
        fs::remove(path);
      }

      void
      expect_plane(const Raster &raster)
      {
        for (unsigned int r = 0; r < raster.n_rows; ++r)
          for (unsigned int i = 0; i < raster.n_columns; ++i)
            EXPECT_NEAR(raster.value(i, r),
                        plane(raster.x(i), raster.y(r)),
                        1e-12);
      }

      void
      expect_refused(const std::string &words)
      {
        const std::string message =
          message_of<ExcUser>([&]() { read_raster(path); });
        EXPECT_NE(message.find(words), std::string::npos) << message;
      }

      const fs::path path;
    };
  } // namespace



  TEST_F(NetcdfTest, AsGmtWritesIt)
  {
    NetcdfWriter(path, "x", {10., 12., 14., 16.}, "y", {100., 105., 110.})
      .add("z", GDT_Float32, [](const double x, const double y) {
        return x == 12. && y == 105. ? -32767. : plane(x, y);
      });
    Raster raster = read_raster(path);
    EXPECT_EQ(raster.west, 9.);
    EXPECT_EQ(raster.south, 97.5);
    EXPECT_EQ(raster.dx, 2.);
    EXPECT_EQ(raster.dy, 5.);
    ASSERT_EQ(raster.values.size(), 12u);
    EXPECT_TRUE(std::isnan(raster.values[5]));
    raster.values[5] = plane(12., 105.);
    expect_plane(raster);
    EXPECT_NE(map_unit(raster.coordinate_system), MapUnit::degrees);
  }



  // South first as GEBCO has it, and north first; packed in whole numbers; beside
  // another array, which has no heights.
  TEST_F(NetcdfTest, RowsBothWaysAndPacked)
  {
    for (const bool ascends : {true, false})
      {
        {
          NetcdfWriter file(path,
                            "lon",
                            {4., 4.5, 5.},
                            "lat",
                            ascends ? std::vector<double>{63., 63.5}
                                    : std::vector<double>{63.5, 63.});
          file.add("elevation", GDT_Int16, plane, 0.0625, 50.);
          file.add("tid", GDT_Byte, [](double, double) { return 3.; });
        }
        const Raster raster = read_raster(path);
        ASSERT_EQ(raster.values.size(), 6u);
        EXPECT_EQ(raster.west, 3.75);
        expect_plane(raster);
        EXPECT_EQ(map_unit(raster.coordinate_system), MapUnit::degrees);
      }
  }



  TEST_F(NetcdfTest, RefusesWhatIsNoRasterOfHeights)
  {
    NetcdfWriter(path, "x", {1., 2., 4.}, "y", {1., 2.})
      .add("z", GDT_Float64, plane);
    expect_refused("cells that are evenly spaced");
    {
      NetcdfWriter file(path, "x", {1., 2., 3.}, "y", {1., 2.});
      file.add("u", GDT_Float64, plane);
      file.add("v", GDT_Float64, plane);
    }
    expect_refused("heights, but u, v, where");
    NetcdfWriter(path, "x", {1., 2., 3.}, "y", {1., 2.})
      .add("z", GDT_Float64, plane)
      ->CreateAttribute("positive", {}, GDALExtendedDataType::CreateString())
      ->Write("down");
    expect_refused("positive downwards");
    NetcdfWriter(path, "x", {1., 2., 3.}, "y", {1., 2.});
    expect_refused("GDAL cannot read it (");
  }
} // namespace netcdf_test

#endif
