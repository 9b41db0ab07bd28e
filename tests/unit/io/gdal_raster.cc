// SPDX-License-Identifier: LGPL-2.1-or-later
// Rasters by GDAL: the plane z = a x + b y + c is read back from GeoTIFF and
// from netCDF-4 (HDF5 by another library than ours). Files without a raster of
// heights are refused. A raster written by talus is read back bit by bit, with
// the map.

#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/raster_file.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <sstream>

#include <unistd.h>

#include <gdal_priv.h>

using namespace talus;
namespace fs = std::filesystem;

// A namespace of its own: several files are compiled as one.
namespace gdal_raster_test
{
  namespace
  {
    double
    plane(const double x, const double y)
    {
      return 0.125 * x - 0.5 * y + 7.;
    }



    class GdalRasterTest : public testing::Test
    {
    protected:
      GdalRasterTest()
        : path(fs::temp_directory_path() /
               ("talus-gdal-raster-" + std::to_string(getpid()) + ".nc"))
      {}

      ~GdalRasterTest() override
      {
        fs::remove(path);
      }

      void
      expect_refused(const std::function<void()> &action,
                     const std::string           &sentence)
      {
        std::string words;
        try
          {
            action();
          }
        catch (const ExcUser &error)
          {
            std::istringstream lines(error.what());
            for (std::string word; lines >> word;)
              words += word + ' ';
          }
        EXPECT_NE(words.find(sentence), std::string::npos)
          << sentence << ": " << words;
      }

      void
      expect_refused(const std::string &sentence)
      {
        expect_refused([this] { check_in_metres(path, read_raster(path)); },
                       sentence);
      }

      void
      expect_plane(const Raster &raster)
      {
        for (unsigned int r = 0; r < raster.n_rows; ++r)
          for (unsigned int i = 0; i < raster.n_columns; ++i)
            EXPECT_NEAR(raster.value(i, r),
                        plane(raster.x(i), raster.y(r)),
                        1e-9);
      }

      const fs::path path;
    };
  } // namespace



  namespace
  {
    using Frame = std::array<double, 6>;

    /// Cells of 200 m x 100 m, the northernmost row first.
    constexpr Frame frame = {{12000., 200., 0., 4300., 0., -100.}};

    /// Write a GeoTIFF of 4 x 3 values of the plane, of which one is missing.
    /// Heights are numbers of lengths @p length, m; @p unit is the name of the
    /// length, empty if the file has none.
    void
    write_tiff(const fs::path    &path,
               const Frame       *place   = &frame,
               const std::string &system  = "EPSG:32633",
               const int          n_bands = 1,
               const std::string &unit    = "",
               const double       length  = 1.)
    {
      GDALAllRegister();
      const GDALDatasetUniquePtr file(
        GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
          path.c_str(), 4, 3, n_bands, GDT_Float32, nullptr));
      const Frame        t = (place == nullptr ? frame : *place);
      std::vector<float> values;
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int i = 0; i < 4; ++i)
          values.push_back(
            plane(t[0] + (i + 0.5) * t[1], t[3] + (r + 0.5) * t[5]) / length);
      values[5] = -9999.f;
      if (place != nullptr)
        file->SetGeoTransform(const_cast<double *>(place->data()));
      OGRSpatialReference words;
      words.SetFromUserInput(system.c_str());
      file->SetSpatialRef(&words);
      file->GetRasterBand(1)->SetNoDataValue(-9999.);
      if (!unit.empty())
        file->GetRasterBand(1)->SetUnitType(unit.c_str());
      ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Write,
                                                 0,
                                                 0,
                                                 4,
                                                 3,
                                                 values.data(),
                                                 4,
                                                 3,
                                                 GDT_Float32,
                                                 0,
                                                 0,
                                                 nullptr),
                CE_None);
    }



    /// Writes arrays over two coordinates, the second of which has rows.
    class NetcdfWriter
    {
    public:
      NetcdfWriter(const fs::path            &path,
                   const std::string         &x_name,
                   const std::vector<double> &x,
                   const std::string         &y_name,
                   const std::vector<double> &y,
                   const std::string         &unit = "")
        : x_(x)
        , y_(y)
        , unit_(unit)
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
          const double       scale  = 1.,
          const double       offset = 0.)
      {
        auto array = add_array(name, axes_, type);
        if (scale != 1.)
          {
            array->SetScale(scale);
            array->SetOffset(offset);
          }
        array->SetNoDataValue(-32767.);
        std::vector<double> values;
        for (const double y : y_)
          for (const double x : x_)
            values.push_back((plane(x, y) - offset) / scale);
        write(*array, values);
        return array;
      }

    private:
      using Axes = std::vector<std::shared_ptr<GDALDimension>>;

      std::shared_ptr<GDALMDArray>
      add_array(const std::string &name,
                const Axes        &axes,
                const GDALDataType type)
      {
        return file_->GetRootGroup()->CreateMDArray(
          name, axes, GDALExtendedDataType::Create(type));
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
        auto axis =
          file_->GetRootGroup()->CreateDimension(name, "", "", values.size());
        auto array = add_array(name, {axis}, GDT_Float64);
        if (name[0] == 'l' || !unit_.empty())
          array->SetUnit(unit_.empty() ? unit : unit_);
        write(*array, values);
        return axis;
      }

      GDALDatasetUniquePtr      file_;
      const std::vector<double> x_, y_;
      const std::string         unit_; ///< of the axes, if given
      Axes                      axes_;
    };
  } // namespace



  // From the north as usual, and from the south.
  TEST_F(GdalRasterTest, PlaneOfGeotiff)
  {
    const Frame upwards = {{frame[0], frame[1], 0., 4000., 0., 100.}};
    for (const Frame *place : {&frame, &upwards})
      {
        write_tiff(path, place);
        Raster raster = read_raster(path);
        ASSERT_EQ(raster.values.size(), 12u);
        EXPECT_EQ(raster.west, 12000.);
        EXPECT_EQ(raster.south, 4000.);
        EXPECT_EQ(raster.dx, 200.);
        EXPECT_EQ(raster.dy, 100.);
        const unsigned int row = 1, column = 1;
        EXPECT_TRUE(std::isnan(raster.value(column, row)));
        raster.values[5] = plane(raster.x(column), raster.y(row));
        expect_plane(raster);
      }
  }



  TEST_F(GdalRasterTest, RefusesGeotiffThatIsNoMapInMetres)
  {
    write_tiff(path, nullptr);
    expect_refused("has no georeference");
    const Frame turned = {{12000., 200., 10., 4300., 10., -100.}};
    write_tiff(path, &turned);
    expect_refused("lies askew");
    write_tiff(path, &frame, "EPSG:32633", 3);
    expect_refused("has 3 bands, where one");
    const Frame degrees = {{14., 0.5, 0., 68., 0., -0.5}};
    write_tiff(path, &degrees, "EPSG:4326");
    expect_refused("is in degrees: its cells are 0.5 wide");
    expect_refused("Set `Projection` = UTM 33N");
    // New York, Long Island.
    const Frame feet = {{1e6, 50., 0., 2e5, 0., -50.}};
    write_tiff(path, &feet, "EPSG:2263");
    expect_refused("is not in metres");
    expect_refused("Set `Projection` = UTM 18N");
    write_tiff(path);
    fs::resize_file(path, 100);
    expect_refused("GDAL cannot read it (");
  }



  // The unit is that of the band, or that of the vertical axis.
  TEST_F(GdalRasterTest, HeightsAreConvertedFromTheirUnit)
  {
    constexpr double survey_foot                               = 1200. / 3937.;
    const std::tuple<std::string, std::string, double> files[] = {
      {"", "metre", 1.},
      {"", "ft", 0.3048},
      {"", "US survey foot", survey_foot},
      {"", "cm", 0.01},
      {"", "km", 1000.},
      {"+5773", "", 1.},
      {"+6360", "", survey_foot},
      {"+6360", "US survey foot", survey_foot}};
    for (const auto &[vertical, unit, length] : files)
      {
        write_tiff(path, &frame, "EPSG:32633" + vertical, 1, unit, length);
        Raster raster    = read_raster(path);
        raster.values[5] = plane(raster.x(1), raster.y(1));
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int i = 0; i < 4; ++i)
            EXPECT_NEAR(raster.value(i, r),
                        plane(raster.x(i), raster.y(r)),
                        1e-3)
              << vertical << ' ' << unit;
        // The maps of the results are in metres.
        EXPECT_EQ(well_known_text(raster.coordinate_system),
                  well_known_text("EPSG:32633"));
      }
  }



  TEST_F(GdalRasterTest, UnknownUnitsAreRefused)
  {
    write_tiff(path, &frame, "EPSG:32633", 1, "furlong");
    expect_refused("heights in 'furlong', where metres");
    write_tiff(path, &frame, "EPSG:32633+6360", 1, "m");
    expect_refused("heights in 'm', but a vertical axis with a unit of 0.3048");
    write_tiff(path, &frame, "EPSG:32633+5715");
    expect_refused("a vertical axis that points down");
    NetcdfWriter(path, "x", {1., 2., 3.}, "y", {1., 2.}, "km")
      .add("z", GDT_Float32);
    expect_refused("' in 'km', where metres were expected");
    NetcdfWriter(path, "x", {1., 2., 3.}, "y", {1., 2.}, "meters")
      .add("z", GDT_Float32)
      ->SetUnit("m");
    expect_plane(read_raster(path));
    NetcdfWriter(path, "x", {1., 2., 3.}, "y", {1., 2.})
      .add("z", GDT_Float32)
      ->SetUnit("feet");
    EXPECT_NEAR(read_raster(path).value(0, 1), 0.3048 * plane(1., 1.), 1e-6);
  }



  // A mark in double precision, of which the file has the single precision; a
  // mark that the file does not declare.
  TEST_F(GdalRasterTest, MarksOfMissingData)
  {
    const auto mark = [&](const double value, const double declared) {
      write_tiff(path);
      const GDALDatasetUniquePtr file(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
      GDALRasterBand &band   = *file->GetRasterBand(1);
      float           number = value;
      band.SetNoDataValue(declared);
      ASSERT_EQ(
        band.RasterIO(
          GF_Write, 1, 1, 1, 1, &number, 1, 1, GDT_Float32, 0, 0, nullptr),
        CE_None);
    };
    mark(0.1, 0.1);
    EXPECT_TRUE(std::isnan(read_raster(path).value(1, 1)));
    mark(-99999., -9999.);
    expect_refused("has heights from -99999 to ");
    expect_refused("gdal_edit.py -a_nodata -99999 " + path.string());
    mark(std::numeric_limits<float>::lowest(), -9999.);
    expect_refused("nodata_value -3.4028234663852886e+38 in the head");
    mark(-9999., 0.);
    expect_refused("is -9999 a value for no data");
  }



  // Only the blocks around the mesh are read: the others do not exist in the
  // file. Values lie where they do in the whole raster, from north and south.
  TEST_F(GdalRasterTest, PartOfAHugeRaster)
  {
    for (const double dy : {-1., 1.})
      {
        {
          const char *const options[] = {"TILED=YES",
                                         "SPARSE_OK=TRUE",
                                         nullptr};
          GDALAllRegister();
          const GDALDatasetUniquePtr file(
            GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
              path.c_str(),
              100000,
              100000,
              1,
              GDT_Float32,
              const_cast<char **>(options)));
          Frame t = {{0., 1., 0., dy < 0. ? 1e5 : 0., 0., dy}};
          file->SetGeoTransform(t.data());
          std::vector<float> values;
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int i = 0; i < 4; ++i)
              values.push_back(plane(700.5 + i, t[3] + dy * (60000.5 + r)) +
                               3e4);
          ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Write,
                                                     700,
                                                     60000,
                                                     4,
                                                     3,
                                                     values.data(),
                                                     4,
                                                     3,
                                                     GDT_Float32,
                                                     0,
                                                     0,
                                                     nullptr),
                    CE_None);
        }
        Raster raster = read_raster(path, [dy](Raster whole) {
          whole.west      = 700.;
          whole.south     = dy < 0. ? 1e5 - 60003. : 60000.;
          whole.n_columns = 4;
          whole.n_rows    = 3;
          return whole;
        });
        ASSERT_EQ(raster.values.size(), 12u);
        for (double &value : raster.values)
          value -= 3e4;
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int i = 0; i < 4; ++i)
            EXPECT_NEAR(raster.value(i, r),
                        plane(raster.x(i), raster.y(r)),
                        0.01);
        expect_refused("100000 x 100000 values at the mesh");
      }
  }



  TEST_F(GdalRasterTest, NetcdfAsGmtWritesIt)
  {
    NetcdfWriter(path, "x", {10., 12., 14., 16.}, "y", {100., 105., 110.})
      .add("z", GDT_Float32);
    const Raster raster = read_raster(path);
    EXPECT_EQ(raster.west, 9.);
    EXPECT_EQ(raster.south, 97.5);
    EXPECT_EQ(raster.dx, 2.);
    EXPECT_EQ(raster.dy, 5.);
    ASSERT_EQ(raster.values.size(), 12u);
    expect_plane(raster);
    EXPECT_NE(map_unit(raster.coordinate_system), MapUnit::degrees);
  }



  // Rows from the south, as in GEBCO, and from the north; packed in whole
  // numbers; beside another array, which has no heights.
  TEST_F(GdalRasterTest, NetcdfRowsBothWaysAndPacked)
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
          file.add("elevation", GDT_Int16, 0.0625, 50.);
          file.add("tid", GDT_Int16);
        }
        const Raster raster = read_raster(path);
        ASSERT_EQ(raster.values.size(), 6u);
        EXPECT_EQ(raster.west, 3.75);
        expect_plane(raster);
        EXPECT_EQ(map_unit(raster.coordinate_system), MapUnit::degrees);
      }
  }



  TEST_F(GdalRasterTest, RefusesNetcdfWithoutHeights)
  {
    NetcdfWriter(path, "x", {1., 2., 4.}, "y", {1., 2.}).add("z", GDT_Float64);
    expect_refused("evenly spaced cells");
    // A column is missing, where GDAL itself does not look.
    std::vector<double> x(15);
    std::iota(x.begin(), x.begin() + 10, 0.);
    std::iota(x.begin() + 10, x.end(), 11.);
    NetcdfWriter(path, "x", x, "y", {1., 2.}).add("z", GDT_Float64);
    expect_refused("has coordinates 'x' that are not evenly spaced");
    {
      NetcdfWriter file(path, "x", {1., 2., 3.}, "y", {1., 2.});
      file.add("u", GDT_Float64);
      file.add("v", GDT_Float64);
    }
    expect_refused("heights, but u, v, where");
    NetcdfWriter(path, "x", {1., 2., 3.}, "y", {1., 2.})
      .add("z", GDT_Float64)
      ->CreateAttribute("positive", {}, GDALExtendedDataType::CreateString())
      ->Write("down");
    expect_refused("positive downwards");
  }



  TEST_F(GdalRasterTest, WritesAndReadsEveryBit)
  {
    std::mt19937                           random(5);
    std::uniform_real_distribution<double> some(-4000., 10.);
    for (const std::string system : {"", "EPSG:32633", "EPSG:3575"})
      {
        Raster raster;
        raster.n_columns         = 13;
        raster.n_rows            = 7;
        raster.west              = 612345.678901;
        raster.south             = 7.1e6 + 0.5;
        raster.dx                = 12.3;
        raster.dy                = 0.125;
        raster.coordinate_system = system;
        for (unsigned int i = 0; i < 13 * 7; ++i)
          raster.values.push_back(i % 10 == 9 ? std::nan("") : some(random));
        raster.values[0] = 1e-310; // denormal
        raster.values[1] = -0.;
        write_geotiff(path, raster);
        const Raster same = read_raster(path);
        ASSERT_EQ(same.n_columns, 13u);
        ASSERT_EQ(same.n_rows, 7u);
        EXPECT_EQ(same.west, raster.west);
        EXPECT_EQ(same.south, raster.south);
        EXPECT_EQ(same.dx, raster.dx);
        EXPECT_EQ(same.dy, raster.dy);
        EXPECT_EQ(std::memcmp(same.values.data(),
                              raster.values.data(),
                              13 * 7 * sizeof(double)),
                  0);
        EXPECT_EQ(well_known_text(same.coordinate_system),
                  well_known_text(system));
        // What was read can be written in turn.
        std::stringstream once, twice;
        once << std::ifstream(path, std::ios::binary).rdbuf();
        write_geotiff(path, same);
        twice << std::ifstream(path, std::ios::binary).rdbuf();
        EXPECT_EQ(once.str(), twice.str());
      }
  }



  TEST_F(GdalRasterTest, SystemThatNobodyKnowsIsRefused)
  {
    check_geotiff(well_known_text("EPSG:32633"));
    for (const std::string words :
         {"somewhere", "EPSG:1", "PROJCS[", "/etc/hosts"})
      expect_refused([&] { check_geotiff(words); }, "is not known to GDAL");
  }
} // namespace gdal_raster_test
