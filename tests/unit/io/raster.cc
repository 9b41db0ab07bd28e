// SPDX-License-Identifier: LGPL-2.1-or-later
// Rasters: the plane z = a x + b y + c comes back from each dialect, and what is
// no raster in metres is refused with a sentence.

#include <talus/base/errors.h>
#include <talus/io/esri_grid.h>
#include <talus/io/hdf5_handle.h>
#include <talus/io/netcdf_raster.h>
#include <talus/io/raster_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include <unistd.h>

using namespace talus;
namespace fs = std::filesystem;

// A namespace of its own: several files are compiled as one.
namespace raster_test
{
  namespace
  {
    constexpr double a = 0.125, b = -0.5, c = 7.;

    double
    value_of_plane(const double x, const double y)
    {
      return a * x + b * y + c;
    }



    /// A file that is removed at the end of a test.
    class RasterTest : public testing::Test
    {
    protected:
      RasterTest()
        : path(fs::temp_directory_path() /
               ("talus-raster-" + std::to_string(getpid())))
      {}

      ~RasterTest() override
      {
        fs::remove(path);
      }

      Raster
      read(const std::string &content)
      {
        std::ofstream(path, std::ios::binary) << content;
        return read_raster(path);
      }

      /// What the user is told.
      std::string
      error(const std::function<void()> &action)
      {
        try
          {
            action();
          }
        catch (const ExcUser &error)
          {
            // deal.II breaks lines.
            std::istringstream words(error.what());
            std::string        result;
            for (std::string word; words >> word;)
              result += (result.empty() ? "" : " ") + word;
            return result;
          }
        return "";
      }

      std::string
      error(const std::string &content)
      {
        return error([&] { read(content); });
      }

      void
      expect_error(const std::string &content, const std::string &sentence)
      {
        EXPECT_NE(error(content).find(sentence), std::string::npos)
          << error(content);
      }

      const fs::path path;
    };



    /// Rows of the plane, 4 columns and 3 rows of cells of 200 m x 100 m whose
    /// corner is (1000, 2000).
    std::string
    rows(const std::string &separator = " ", const char point = '.')
    {
      std::ostringstream out;
      for (int r = 0; r < 3; ++r)
        for (int i = 0; i < 4; ++i)
          {
            std::ostringstream number;
            number << value_of_plane(1000. + (i + 0.5) * 200.,
                                     2000. + (2.5 - r) * 100.);
            std::string digits = number.str();
            if (const auto at = digits.find('.'); at != std::string::npos)
              digits[at] = point;
            out << digits << (i < 3 ? separator : "\n");
          }
      return out.str();
    }



    const std::string header = "ncols 4\nnrows 3\nxllcorner 1000\nyllcorner "
                               "2000\ndx 200\ndy 100\n";



    /// Largest distance of the values from the plane.
    double
    distance_from_plane(const Raster &raster)
    {
      double result = 0.;
      for (unsigned int r = 0; r < raster.n_rows; ++r)
        for (unsigned int i = 0; i < raster.n_columns; ++i)
          result = std::max(result,
                            std::abs(raster.value(i, r) -
                                     value_of_plane(raster.x(i), raster.y(r))));
      return result;
    }



    /// Writes a netCDF-4 file as the library of that name lays it out.
    class NetcdfWriter
    {
    public:
      explicit NetcdfWriter(const fs::path &path)
        : file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
               H5Fclose)
      {}

      void
      add(const std::string          &name,
          const hid_t                 type,
          const std::vector<hsize_t> &shape,
          const std::vector<double>  &values)
      {
        const Hdf5Handle space(
          H5Screate_simple(shape.size(), shape.data(), nullptr), H5Sclose);
        const Hdf5Handle array(H5Dcreate2(file,
                                          name.c_str(),
                                          type,
                                          space,
                                          H5P_DEFAULT,
                                          H5P_DEFAULT,
                                          H5P_DEFAULT),
                               H5Dclose);
        ASSERT_GE(H5Dwrite(array,
                           H5T_NATIVE_DOUBLE,
                           H5S_ALL,
                           H5S_ALL,
                           H5P_DEFAULT,
                           values.data()),
                  0);
      }

      void
      add_number(const std::string &name,
                 const std::string &attribute,
                 const hid_t        type,
                 const double       value)
      {
        const hsize_t    one = 1;
        const Hdf5Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
        write_attribute(
          name, attribute, type, space, H5T_NATIVE_DOUBLE, &value);
      }

      void
      add_text(const std::string &name,
               const std::string &attribute,
               const std::string &value)
      {
        const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
        const Hdf5Handle type = text_type(value);
        write_attribute(name, attribute, type, space, type, value.data());
      }

    private:
      void
      write_attribute(const std::string &name,
                      const std::string &attribute,
                      const hid_t        type,
                      const hid_t        space,
                      const hid_t        memory_type,
                      const void        *value)
      {
        const Hdf5Handle array(H5Dopen2(file, name.c_str(), H5P_DEFAULT),
                               H5Dclose);
        const Hdf5Handle handle(
          H5Acreate2(
            array, attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
          H5Aclose);
        ASSERT_GE(H5Awrite(handle, memory_type, value), 0);
      }

      Hdf5Handle file;
    };



    /// Coordinates and values of the plane, along x and y as given.
    struct MapFrame
    {
      std::vector<double> x, y;

      std::vector<double>
      values(const std::function<double(double)> &pack) const
      {
        std::vector<double> result;
        for (const double yi : y)
          for (const double xi : x)
            result.push_back(pack(value_of_plane(xi, yi)));
        return result;
      }

      std::vector<hsize_t>
      shape() const
      {
        return {y.size(), x.size()};
      }
    };
  } // namespace



  TEST_F(RasterTest, PlaneComesBackFromEachDialect)
  {
    const std::vector<std::string> dialects = {
      header + "NODATA_value -9999\n" + rows(),
      // Other words, cases and separators.
      "nCols 4\nnRows 3\nXLLCENTER 1100\nyllcentre 2050\nDX 200\nDY 100\n" +
        rows("\t"),
      header + "nodata nan\n" + rows(", "),
      header + "nodata_value nan\n" + rows(","),
      header + "nodata_value -9999,5\n" + rows(" ", ','),
      header + rows(";", ','),
      "ncols,4\nnrows,3\nxllcorner,1000\nyllcorner,2000\ndx,200\ndy,100\n" +
        rows(","),
      "4 ncols\n3 nrows\n1000 xllcorner\n2000 yllcorner\n200 dx\n100 dy\n" +
        rows("  "),
      "\xef\xbb\xbfnrows 3\r\nncols 4\r\ndy 100\r\ndx 2.e+2\r\nyllcorner "
      "2000\r\nxllcorner +1000\r\n\r\n" +
        rows() + "\r\n",
    };
    for (const std::string &content : dialects)
      {
        const Raster raster = read(content);
        ASSERT_EQ(raster.values.size(), 12u) << content;
        EXPECT_EQ(raster.west, 1000.) << content;
        EXPECT_EQ(raster.south, 2000.) << content;
        EXPECT_LT(distance_from_plane(raster), 1e-12) << content;
      }
  }



  // The commonest fault of all such codes: to take centres for corners.
  TEST_F(RasterTest, HalfACellOffIsSeen)
  {
    std::string content = header + rows();
    content.replace(content.find("xllcorner"), 9, "xllcenter");
    EXPECT_NEAR(distance_from_plane(read(content)), 0.5 * 200. * a, 1e-12);
  }



  TEST_F(RasterTest, SquareCells)
  {
    const Raster raster =
      read("ncols 2\nnrows 2\nxllcorner 1.5\nyllcorner -3\ncellsize 0.5\n"
           "1 2\n-9999 4\n");
    EXPECT_EQ(raster.x(0), 1.75);
    EXPECT_EQ(raster.y(0), -2.25);
    EXPECT_EQ(raster.y(1), -2.75);
    EXPECT_EQ(raster.value(1, 0), 2.);
    EXPECT_TRUE(std::isnan(raster.value(0, 1))); // -9999 without being told
  }



  TEST_F(RasterTest, WritesAndReadsEveryBit)
  {
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> some(-4000., 10.);
    for (const double dy : {12.3, 0.1 + 0.2})
      {
        Raster raster;
        raster.n_columns = 13;
        raster.n_rows    = 7;
        raster.west      = 612345.678901;
        raster.south     = 7.1e6 + 1. / 3.;
        raster.dx        = 12.3;
        raster.dy        = dy;
        for (unsigned int i = 0; i < 13 * 7; ++i)
          raster.values.push_back(i % 10 == 9 ? std::nan("") : some(random));
        raster.values[0] = 1e-310; // denormal
        raster.values[1] = -0.;
        write_esri_grid(path, raster);
        const Raster same = read_raster(path);
        EXPECT_EQ(same.n_columns, 13u);
        EXPECT_EQ(same.n_rows, 7u);
        EXPECT_EQ(same.west, raster.west);
        EXPECT_EQ(same.south, raster.south);
        EXPECT_EQ(same.dx, raster.dx);
        EXPECT_EQ(same.dy, raster.dy);
        ASSERT_EQ(same.values.size(), raster.values.size());
        EXPECT_EQ(std::memcmp(same.values.data(),
                              raster.values.data(),
                              13 * 7 * sizeof(double)),
                  0);
      }
  }



  // Which GIS keep beside grids of text, in a file of its own.
  TEST_F(RasterTest, CoordinateSystemBeside)
  {
    const std::string grid =
      "ncols 1\nnrows 1\nxllcorner 4\nyllcorner 63\ncellsize 1\n5\n";
    EXPECT_EQ(read(grid).coordinate_system, "");
    const fs::path beside = path.string() + ".prj";
    std::ofstream(beside) << "PROJCS[\"of the user\"]\r\n";
    EXPECT_EQ(read(grid).coordinate_system, "PROJCS[\"of the user\"]");
    std::ofstream(beside) << "GEOGCS[\"GCS_WGS_1984\"]";
    expect_error(grid, "is in degrees");
    fs::remove(beside);
  }



  TEST_F(RasterTest, NetcdfAsGmtWritesIt)
  {
    const MapFrame lattice{{10., 12., 14., 16.}, {100., 105., 110.}};
    {
      NetcdfWriter file(path);
      file.add("x", H5T_IEEE_F64LE, {4}, lattice.x);
      file.add("y", H5T_IEEE_F64LE, {3}, lattice.y);
      auto z = lattice.values([](const double value) { return value; });
      z[5]   = std::nan("");
      file.add("z", H5T_IEEE_F32LE, lattice.shape(), z);
      file.add_number("z", "_FillValue", H5T_IEEE_F32LE, std::nan(""));
    }
    Raster raster = read_raster(path, RasterUnits::metres);
    EXPECT_EQ(raster.west, 9.);
    EXPECT_EQ(raster.south, 97.5);
    EXPECT_EQ(raster.dx, 2.);
    EXPECT_EQ(raster.dy, 5.);
    EXPECT_TRUE(std::isnan(raster.value(1, 1)));
    raster.values[5] = value_of_plane(raster.x(1), raster.y(1));
    EXPECT_LT(distance_from_plane(raster), 1e-12);
  }



  // South first as GEBCO has it, and north first; whole numbers, packed ones.
  TEST_F(RasterTest, NetcdfRowsBothWaysAndPacked)
  {
    for (const bool ascends : {true, false})
      {
        const MapFrame lattice{{0., 4., 8.},
                               ascends ? std::vector<double>{1000., 1002.}
                                       : std::vector<double>{1002., 1000.}};
        {
          NetcdfWriter file(path);
          file.add("lon", H5T_IEEE_F64LE, {3}, lattice.x);
          file.add("lat", H5T_IEEE_F64LE, {2}, lattice.y);
          file.add("elevation",
                   H5T_STD_I16LE,
                   lattice.shape(),
                   lattice.values(
                     [](const double value) { return (value - 50.) / 0.5; }));
          file.add("tid", H5T_STD_I8LE, lattice.shape(), {1, 2, 3, 4, 5, 6});
          file.add_number("elevation", "scale_factor", H5T_IEEE_F64LE, 0.5);
          file.add_number("elevation", "add_offset", H5T_IEEE_F32LE, 50.);
          file.add_number("elevation", "_FillValue", H5T_STD_I16LE, -32767.);
        }
        EXPECT_LT(distance_from_plane(read_raster(path, RasterUnits::metres)),
                  1e-12);
      }
  }



  TEST_F(RasterTest, DegreesAreRefusedWithTheCommandThatProjects)
  {
    // GEBCO: 15 arc seconds, off Norway.
    const double   h = 15. / 3600.;
    const MapFrame lattice{{4. + 0.5 * h, 4. + 1.5 * h},
                           {63. + 0.5 * h, 63. + 1.5 * h}};
    for (const bool says_so : {true, false})
      {
        {
          NetcdfWriter file(path);
          file.add("lon", H5T_IEEE_F64LE, {2}, lattice.x);
          file.add("lat", H5T_IEEE_F64LE, {2}, lattice.y);
          file.add("elevation", H5T_STD_I16LE, lattice.shape(), {1, 2, 3, 4});
          if (says_so)
            file.add_text("lon", "units", "degrees_east");
        }
        const std::string sentence = error([&] { read_raster(path); });
        EXPECT_NE(sentence.find("gdalwarp -t_srs EPSG:32631 -tr 500 500"),
                  std::string::npos)
          << sentence;
        EXPECT_EQ(read_raster(path, RasterUnits::metres).value(0, 0), 3.);
      }
    // In the south, and west of Greenwich, as an Esri grid.
    const std::string south =
      "ncols 1\nnrows 1\nxllcorner -70.01\nyllcorner -33\ncellsize 0.0001\n5\n";
    expect_error(south, "EPSG:32719 -tr 10 10");
    expect_error(south, "set `Units` = m");
    // A flume.
    EXPECT_EQ(read_raster(path, RasterUnits::metres).value(0, 0), 5.);
  }



  TEST_F(RasterTest, WhatIsNoRasterIsSaid)
  {
    expect_error("CDF\001 and more", "is netCDF-3");
    expect_error("CDF\001 and more", "nccopy -k nc4");
    expect_error(std::string("II*\0 and more", 14),
                 "gdal_translate -of AAIGrid");
    expect_error("\211HDF\r\n\032\n and more", "cannot be read (");
    expect_error("", "cannot be read or is empty");
    expect_error(header + "1 2 3 4\n5 6 7\n8 9 10 11\n",
                 "line 8: row 2 has 3 values, but ncols is 4");
    expect_error(header + "1 2 3 4\n5 6 7 8 9\n8 9 10 11\n",
                 "line 8: row 2 has 5 values");
    expect_error(header + "1 2 3 4\n5 6 x7 8\n8 9 10 11\n",
                 "line 8: 'x7' was found in column 3, where a number");
    expect_error(header + "1 2 3 4\n5 6 7 8\n",
                 "has 2 rows of values, where 3");
    expect_error(header + "1 2 3 4\n5 6 7 8\n1 2 3 4\n1 2 3 4\n",
                 "line 10: there is one more row of values, but nrows is 3");
    expect_error("ncols 4\nnrows 3\ndx 1\ndy 1\nyllcorner 0\n1 2 3 4\n",
                 "has no line with 'xllcorner'");
    expect_error("ncols 4\nnclos 3\n", "line 2: 'nclos 3' was found");
    expect_error("ncols 4\nncols 3\n",
                 "line 2: the keyword 'ncols' is there twice");
    expect_error("ncols 2.5\nnrows 1\n1 2\n", "has ncols = 2.5, where a whole");
    expect_error("ncols 2\nnrows 1\ncellsize 0\n1 2\n", "has cells of 0");
    expect_error("ncols 4\n", "has 0 rows of values, where an Esri ASCII grid");
  }



  TEST_F(RasterTest, NetcdfThatIsNoRasterIsSaid)
  {
    const auto sentence = [&] {
      return error([&] { read_raster(path, RasterUnits::metres); });
    };
    {
      NetcdfWriter file(path);
      file.add("x", H5T_IEEE_F64LE, {3}, {1., 2., 4.});
    }
    EXPECT_NE(sentence().find("'x' that are not evenly spaced (2 at place 2)"),
              std::string::npos)
      << sentence();
    {
      NetcdfWriter file(path);
      file.add("x", H5T_IEEE_F64LE, {2}, {1., 2.});
    }
    EXPECT_NE(sentence().find("no coordinates named lat or latitude or y"),
              std::string::npos)
      << sentence();
    {
      NetcdfWriter file(path);
      file.add("x", H5T_IEEE_F64LE, {2}, {1., 2.});
      file.add("y", H5T_IEEE_F64LE, {2}, {1., 2.});
      file.add("u", H5T_IEEE_F64LE, {2, 2}, {1., 2., 3., 4.});
      file.add("v", H5T_IEEE_F64LE, {2, 2}, {1., 2., 3., 4.});
    }
    EXPECT_NE(sentence().find("has 2 arrays over 'y' and 'x' (u, v)"),
              std::string::npos)
      << sentence();
    {
      NetcdfWriter file(path);
      file.add("x", H5T_IEEE_F64LE, {2}, {1., 2.});
      file.add("y", H5T_IEEE_F64LE, {2}, {1., 2.});
      file.add("z", H5T_IEEE_F64LE, {2, 2}, {1., 2., 3., 4.});
      file.add_text("z", "positive", "down");
    }
    EXPECT_NE(sentence().find("positive downwards"), std::string::npos)
      << sentence();
  }
} // namespace raster_test
