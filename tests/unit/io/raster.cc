// SPDX-License-Identifier: LGPL-2.1-or-later
// Rasters: the plane z = a x + b y + c is read back from each dialect. Files
// without a raster in metres are refused with a sentence.

#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
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
        const Raster raster = read_raster(path);
        check_in_metres(path, raster);
        return raster;
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
  } // namespace



  TEST_F(RasterTest, PlaneComesBackFromEachDialect)
  {
    const std::vector<std::string> dialects = {
      header + "NODATA_value -9999\n" + rows(),
      // Other cases and separators.
      "nCols 4\nnRows 3\nXLLCENTER 1100\nyllcenter 2050\nDX 200\nDY 100\n" +
        rows("\t"),
      header + "nodata_value nan\n" + rows(", "),
      header + "nodata_value -9999,5\n" + rows(" ", ','),
      "ncols  4\nnrows  3\nxllcorner 1000,0\nyllcorner 2000,0\ndx 200,\ndy "
      "100\n" +
        rows("  ", ','),
      "\xef\xbb\xbfnrows 3\r\nncols 4\r\ndy 100\r\ndx 2.e+2\r\nyllcorner "
      "2000\r\nxllcorner +1000\r\n\r\n" +
        rows() + "\r\n",
      // GeoClaw's topography of type 3.
      "  4  mx\n  3  my\n1.1e3 xlower\n2050. ylower\n200 1e2 cellsize\n"
      "-9999 nodata_value\n" +
        rows("  "),
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
    content.replace(content.find("yllcorner"), 9, "yllcenter");
    EXPECT_NEAR(distance_from_plane(read(content)),
                std::abs(0.5 * 200. * a + 0.5 * 100. * b),
                1e-12);
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
    const fs::path    beside = fs::path(path).replace_extension(".prj");
    const std::string system = "LOCAL_CS[\"of the user\",UNIT[\"metre\",1]]";
    std::ofstream(beside) << system + "\r\n";
    EXPECT_EQ(read(grid).coordinate_system, system);
    std::ofstream(beside) << "\xef\xbb\xbf" + system;
    EXPECT_EQ(read(grid).coordinate_system, system);
    std::ofstream(beside) << "What is this?";
    expect_error(grid,
                 beside.string() + "' has the coordinate system 'What is this");
    fs::remove(beside);
  }



  TEST_F(RasterTest, OldFormOfArc)
  {
    const std::string grid =
      "ncols 1\nnrows 1\nxllcorner 4e5\nyllcorner 6e6\ncellsize 1\n5\n";
    const fs::path beside = fs::path(path).replace_extension(".prj");
    const auto     write  = [&](const std::string &unit,
                           const std::string &unit_of_heights) {
      std::ofstream(beside) << "Projection    UTM\r\nZone          33\r\n"
                                    "Datum  WGS84\r\nSpheroid  WGS84\r\n"
                                    "Units         "
                            << unit << "\r\nZunits        " << unit_of_heights
                            << "\r\nParameters\r\n";
    };
    write("FEET", "NO");
    expect_error(grid, "is not in metres: its cells are 1 wide");
    write("METERS", "NO");
    EXPECT_EQ(read(grid).value(0, 0), 5.);
    write("METERS", "FEET");
    EXPECT_NEAR(read(grid).value(0, 0), 5. * 0.3048, 1e-12);
    // Esri's form: both parts one after the other.
    std::ofstream(beside) << well_known_text("EPSG:32633")
                          << ",VERTCS[\"NAVD88_height_(ftUS)\",VDATUM[\"North_"
                             "American_Vertical_Datum_1988\"],PARAMETER["
                             "\"Vertical_Shift\",0.0],PARAMETER[\"Direction\","
                             "1.0],UNIT[\"Foot_US\",0.3048006096012192]]";
    EXPECT_NEAR(read(grid).value(0, 0), 5. * 1200. / 3937., 1e-9);
    fs::remove(beside);
  }



  // Header and rows have the same number in single precision.
  TEST_F(RasterTest, MarksInSinglePrecision)
  {
    const Raster raster =
      read(header + "nodata_value -3.40282346638529e+38\n" +
           "1 2 3 -3.4028234663852886e+38\n" + "5 6 7 8\n8 9 10 11\n");
    EXPECT_TRUE(std::isnan(raster.value(3, 0)));
    EXPECT_EQ(raster.value(2, 0), 3.);
    expect_error(header + "nodata_value 1\n1 1 1 1\n1 1 1 1\n1 1 1 1\n",
                 "has no value at the mesh");
    // The advice is followed.
    const std::string rows =
      "1 2 3 -3.4028234663852886e+38\n5 6 7 8\n1 2 3 4\n";
    expect_error(header + rows, "nodata_value -3.4028234663852886e+38 in");
    EXPECT_TRUE(
      std::isnan(read(header + "nodata_value -3.4028234663852886e+38\n" + rows)
                   .value(3, 0)));
  }



  TEST_F(RasterTest, PartIsStored)
  {
    read(header + rows());
    const Raster raster = read_raster(path, [](Raster whole) {
      whole.west += whole.dx;
      whole.south += whole.dy;
      whole.n_columns = 2;
      whole.n_rows    = 1;
      return whole;
    });
    ASSERT_EQ(raster.values.size(), 2u);
    EXPECT_LT(distance_from_plane(raster), 1e-12);
    // The rows beside are counted, too.
    expect_error(header + "1 2 3 4\n5 6 7\n8 9 10 11\n", "row 2 has 3 values");
  }



  // Off Norway; in the south, and west of Greenwich.
  TEST_F(RasterTest, DegreesAreRefusedWithTheZone)
  {
    const fs::path beside = fs::path(path).replace_extension(".prj");
    std::ofstream(beside) << "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\","
                             "SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],"
                             "PRIMEM[\"Greenwich\",0.0],"
                             "UNIT[\"Degree\",0.0174532925199433]]";
    const std::string north =
      "ncols 1\nnrows 1\nxllcorner 4\nyllcorner 63\ncellsize 0.0041666\n5\n";
    expect_error(north, "is in degrees: its cells are 0.0041666 wide");
    expect_error(north, "Set `Projection` = UTM 31N");
    expect_error(
      "ncols 1\nnrows 1\nxllcorner -70.01\nyllcorner -33\ncellsize 0.0001\n5\n",
      "UTM 19S");
    fs::remove(beside);
    // Without a word on its coordinates a raster is in metres: a flume.
    EXPECT_EQ(read(north).value(0, 0), 5.);
  }



  TEST_F(RasterTest, WhatIsNoRasterIsSaid)
  {
    for (const std::string &begin : {std::string("CDF\001 and more"),
                                     std::string("II*\0 and more", 14),
                                     std::string("\211HDF\r\n\032\n and more"),
                                     std::string("<html>\n")})
      {
        expect_error(begin, "is no Esri ASCII grid, which begins with ncols");
        expect_error(begin, "GDAL cannot read it (");
      }
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
    const std::string row = "1 2 3 4\n";
    for (const std::string place :
         {"yllcorner 0\n",
          "xllcorner 0\nyllcenter 0\n",
          "xllcorner 0\nyllcorner 0\nxllcenter 5\nyllcenter 5\n"})
      expect_error("ncols 4\nnrows 1\ndx 1\ndy 1\n" + place + row,
                   "has no place on the map, which an Esri ASCII grid needs");
    for (const std::string line : {"nodata 3",
                                   "ncols 4",
                                   "yllcentre 4",
                                   "xllcorner 7 cellsize 5",
                                   "NODATA_value x",
                                   "dz 3",
                                   "nan 1 2 3"})
      expect_error(header + line + "\n" + row + row + row,
                   "line 7: '" + line + "' was found, where a keyword");
    for (const std::string word :
         {"1,2", "1;2", "1.5.5", "inf", "-nan", "1e999"})
      expect_error(header + row + row + "1 2 3 " + word + "\n",
                   word == "1,2"
                     ? ""
                     : "line 9: '" + word + "' was found in column 4");
    expect_error(header + "1,2,3,4\n" + row + row,
                 "line 7: row 1 has 1 values");
    expect_error(header + "# a remark\n" + row + row,
                 "line 7: row 1 has 3 val");
    expect_error("ncols 2.5\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize "
                 "1\n1 2 3\n",
                 "row 1 has 3 values, but ncols is 2");
    expect_error("ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize "
                 "0\n1 2\n",
                 "has cells of 0");
    for (const std::string words :
         {"ncols 4\n", "ncols 4\nnclos 3\n", "4 ncols\n"})
      expect_error(words, "GDAL cannot read it (");
  }
} // namespace raster_test
