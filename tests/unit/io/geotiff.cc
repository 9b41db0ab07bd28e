// SPDX-License-Identifier: LGPL-2.1-or-later
// GeoTIFF, written here byte by byte as the formats say: the plane
// z = a x + b y + c comes back, and what is no raster on a map is refused. What
// we write comes back by bit, with its map.

#include <talus/base/errors.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/raster_file.h>
#include <talus/version.h>

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
namespace geotiff_test
{
  namespace
  {
    constexpr unsigned int n_columns = 4, n_rows = 3;
    constexpr double west = 512000., north = 6742300., dx = 200., dy = 100.;

    double
    plane(const double x, const double y)
    {
      return 0.125 * (x - west) - 0.5 * (y - north) + 7.;
    }



    /// TIFF 6.0 in the order of bytes of Intel's, of one strip.
    class TiffBytes
    {
    public:
      template <typename T>
      void
      add(const unsigned short  tag,
          const unsigned short  type,
          const std::vector<T> &values)
      {
        Entry entry{tag, type, unsigned(values.size()), {}};
        entry.bytes.resize(values.size() * sizeof(T));
        std::memcpy(entry.bytes.data(), values.data(), entry.bytes.size());
        entries_.push_back(entry);
      }

      /// @p pixels are the first thing behind the eight bytes of the head.
      std::string
      file(const std::vector<float> &pixels) const
      {
        const std::string  data(reinterpret_cast<const char *>(pixels.data()),
                               pixels.size() * sizeof(float));
        const unsigned int directory = 8 + data.size();
        unsigned int       next      = directory + 6 + 12 * entries_.size();
        std::string        large;
        std::string result = std::string("II*\0", 4) + word(directory) + data;
        result += half(entries_.size());
        for (const Entry &entry : entries_)
          {
            result += half(entry.tag) + half(entry.type) + word(entry.n);
            std::string value = entry.bytes;
            value.resize(std::max<std::size_t>(4, value.size()), '\0');
            if (value.size() > 4)
              {
                large += value;
                result += word(next);
                next += value.size();
              }
            else
              result += value;
          }
        return result + word(0) + large;
      }

    private:
      struct Entry
      {
        unsigned short tag, type;
        unsigned int   n;
        std::string    bytes;
      };

      static std::string
      half(const unsigned short number)
      {
        return {reinterpret_cast<const char *>(&number), 2};
      }

      static std::string
      word(const unsigned int number)
      {
        return {reinterpret_cast<const char *>(&number), 4};
      }

      std::vector<Entry> entries_;
    };



    using Shorts  = std::vector<unsigned short>;
    using Words   = std::vector<unsigned int>;
    using Doubles = std::vector<double>;

    /// What differs from file to file.
    struct Georeference
    {
      /// GeoKeys: raster type (1 values of areas, 2 of points), model (1 map, 2
      /// degrees), and the number of the system.
      unsigned short raster_type = 1, model = 1, system = 32633;
      Doubles        scale   = {dx, dy, 0.};
      Doubles        tie     = {0., 0., 0., west, north, 0.};
      std::string    missing = "-9999";
    };



    /// Tags ascend, as TIFF asks.
    std::string
    geotiff(const std::vector<float> &pixels,
            const Georeference       &at = Georeference())
    {
      const unsigned short key_of_system = (at.model == 1 ? 3072 : 2048);
      TiffBytes            tiff;
      tiff.add(256, 3, Shorts{n_columns});
      tiff.add(257, 3, Shorts{n_rows});
      tiff.add(258, 3, Shorts{32}); // bits
      tiff.add(259, 3, Shorts{1});  // no compression
      tiff.add(262, 3, Shorts{1});
      tiff.add(273, 4, Words{8}); // where the strip begins
      tiff.add(277, 3, Shorts{1});
      tiff.add(278, 3, Shorts{n_rows});
      tiff.add(279, 4, Words{unsigned(pixels.size() * sizeof(float))});
      tiff.add(339, 3, Shorts{3}); // floating point
      if (!at.scale.empty())
        {
          tiff.add(33550, 12, at.scale);
          tiff.add(33922, 12, at.tie);
          tiff.add(34735,
                   3,
                   Shorts{1,
                          1,
                          0,
                          3,
                          1024,
                          0,
                          1,
                          at.model,
                          1025,
                          0,
                          1,
                          at.raster_type,
                          key_of_system,
                          0,
                          1,
                          at.system});
        }
      tiff.add(42113,
               2,
               std::vector<char>(at.missing.begin(), at.missing.end() + 1));
      return tiff.file(pixels);
    }



    std::vector<float>
    pixels()
    {
      std::vector<float> result;
      for (unsigned int r = 0; r < n_rows; ++r)
        for (unsigned int i = 0; i < n_columns; ++i)
          result.push_back(
            plane(west + (i + 0.5) * dx, north - (r + 0.5) * dy));
      return result;
    }



    class GeotiffTest : public testing::Test
    {
    protected:
      GeotiffTest()
        : path(fs::temp_directory_path() /
               ("talus-geotiff-" + std::to_string(getpid()) + ".tif"))
      {}

      ~GeotiffTest() override
      {
        fs::remove(path);
      }

      Raster
      read(const std::string &content)
      {
        std::ofstream(path, std::ios::binary) << content;
        const Raster raster = read_raster(path);
        check_projection(path, raster, "");
        return raster;
      }

      void
      expect_error(const std::string &content, const std::string &sentence)
      {
        expect_error([&] { read(content); }, sentence);
      }

      void
      expect_error(const std::function<void()> &action,
                   const std::string           &sentence)
      {
        try
          {
            action();
            ADD_FAILURE() << "no error: " << sentence;
          }
        catch (const ExcUser &error)
          {
            std::istringstream words(error.what());
            std::string        result;
            for (std::string word; words >> word;)
              result += word + ' ';
            EXPECT_NE(result.find(sentence), std::string::npos) << result;
          }
      }

      const fs::path path;
    };
  } // namespace



#if TALUS_WITH_GDAL

  TEST_F(GeotiffTest, PlaneComesBack)
  {
    // As areas from the corner on, and as points whose first is half a cell away.
    Georeference points;
    points.raster_type = 2;
    points.tie         = {0., 0., 0., west + 0.5 * dx, north - 0.5 * dy, 0.};
    for (const Georeference &at : {Georeference(), points})
      {
        const Raster raster = read(geotiff(pixels(), at));
        ASSERT_EQ(raster.n_columns, n_columns);
        ASSERT_EQ(raster.n_rows, n_rows);
        EXPECT_EQ(raster.west, west);
        EXPECT_EQ(raster.south, north - 300.);
        EXPECT_EQ(raster.dx, dx);
        EXPECT_EQ(raster.dy, dy);
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int i = 0; i < n_columns; ++i)
            EXPECT_EQ(raster.value(i, r), plane(raster.x(i), raster.y(r)));
      }
  }



  TEST_F(GeotiffTest, CellsWithoutData)
  {
    auto values         = pixels();
    values[5]           = -9999.f;
    const Raster raster = read(geotiff(values));
    for (unsigned int i = 0; i < raster.values.size(); ++i)
      EXPECT_EQ(std::isnan(raster.values[i]), i == 5);
  }



  // Told by the file, however large the cells.
  TEST_F(GeotiffTest, Degrees)
  {
    Georeference degrees;
    degrees.model  = 2;
    degrees.system = 4326;
    degrees.scale  = {0.5, 0.5, 0.};
    degrees.tie    = {0., 0., 0., 14., 68., 0.};
    expect_error(geotiff(pixels(), degrees), "is in degrees");
    const Raster raster = read_raster(path);
    EXPECT_EQ(raster.west, 14.);
    EXPECT_EQ(raster.south, 66.5);
  }



  TEST_F(GeotiffTest, RefusesWhatIsNoRasterOnAMap)
  {
    expect_error(std::string("II*\0 and no more", 17), "GDAL cannot read it (");
    expect_error(geotiff(pixels()).substr(0, 100), "GDAL cannot read it (");
    Georeference nowhere;
    nowhere.scale = {};
    expect_error(geotiff(pixels(), nowhere), "where it lies on the map");
    // In feet: New York, Long Island.
    Georeference feet;
    feet.system = 2263;
    expect_error(geotiff(pixels(), feet), "is not in metres");
    expect_error(geotiff(pixels(), feet), "Set `Projection` = UTM 18N");
  }



  TEST_F(GeotiffTest, WritesAndReadsEveryBit)
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
        // Well-known text ends with the number: AUTHORITY["EPSG","32633"]].
        const std::string number =
          system.empty() ? "" : "\"EPSG\",\"" + system.substr(5) + "\"]]";
        const std::string &words = same.coordinate_system;
        EXPECT_EQ(words.substr(words.size() - number.size()), number) << words;
        EXPECT_EQ(words.empty(), system.empty());
        // What was read can be written in turn.
        std::stringstream once, twice;
        once << std::ifstream(path, std::ios::binary).rdbuf();
        write_geotiff(path, same);
        twice << std::ifstream(path, std::ios::binary).rdbuf();
        EXPECT_EQ(once.str(), twice.str());
      }
  }



  // As GIS write it: Esri's names, without a number.
  TEST_F(GeotiffTest, SystemThatNobodyKnowsIsRefused)
  {
    check_geotiff(R"(PROJCS["WGS_1984_UTM_Zone_33N",GEOGCS["GCS_WGS_1984",)"
                  R"(DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,)"
                  R"(298.257223563]],PRIMEM["Greenwich",0.0],)"
                  R"(UNIT["Degree",0.0174532925199433]],)"
                  R"(PROJECTION["Transverse_Mercator"],)"
                  R"(PARAMETER["False_Easting",500000.0],)"
                  R"(PARAMETER["Central_Meridian",15.0],)"
                  R"(PARAMETER["Scale_Factor",0.9996],UNIT["Meter",1.0]])");
    for (const std::string words :
         {"somewhere", "EPSG:1", "PROJCS[", "/etc/hosts"})
      expect_error([&] { check_geotiff(words); }, "is not known to GDAL");
  }

#else

  TEST_F(GeotiffTest, NeedsGdal)
  {
    expect_error(geotiff(pixels()), "gdal_translate -of AAIGrid");
    expect_error([] { check_geotiff(""); }, "'Maps/Write GeoTIFF' is true");
    expect_error([&] { write_geotiff(path, Raster()); }, "built without GDAL");
  }

#endif
} // namespace geotiff_test
