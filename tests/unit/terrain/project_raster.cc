// SPDX-License-Identifier: LGPL-2.1-or-later
// From degrees to metres: the projection against Krueger's series, and rasters
// whose values are a function of easting and northing.

#include <talus/base/errors.h>
#include <talus/geometry/height_field.h>
#include <talus/io/coordinate_system.h>
#include <talus/terrain/project_raster.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "transverse_mercator.h"

using namespace talus;
using dealii::Point;

namespace
{
  std::string
  error(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const ExcUser &error)
      {
        std::istringstream words(error.what());
        std::string        result;
        for (std::string word; words >> word;)
          result += word + ' ';
        return result;
      }
    return "";
  }
} // namespace



TEST(UtmZone, ZonesOfPlaces)
{
  EXPECT_EQ(utm_zone({15.1, 67.}), "UTM 33N");
  EXPECT_EQ(utm_zone({-180., -1.}), "UTM 1S");
  EXPECT_EQ(utm_zone({179.9, -1.}), "UTM 60S");
  EXPECT_EQ(utm_zone({190., 5.}), "UTM 2N");
  EXPECT_EQ(utm_zone({5e5, 7.4e6}, "EPSG:32633"), "UTM 33N");
}



TEST(UtmZone, Codes)
{
  for (const auto &[name, code] : {std::make_pair("UTM 33N", "EPSG:32633"),
                                   std::make_pair("UTM1S", "EPSG:32701"),
                                   std::make_pair("EPSG:3575", "EPSG:3575")})
    EXPECT_EQ(map_code("'Projection'", name), code);
  for (const std::string name : {"UTM 33",
                                 "UTM 33V",
                                 "UTM 61N",
                                 "UTM 0N",
                                 "+proj=utm +zone=33",
                                 "EPSG:4326",
                                 "EPSG:2263",
                                 "EPSG:1",
                                 "/etc/hosts"})
    {
      const std::string sentence =
        error([&] { map_code("'Projection'", name); });
      EXPECT_NE(sentence.find("'Projection' = '" + name +
                              "' was found, where a "
                              "UTM zone from 1 to 60 and a hemisphere"),
                std::string::npos)
        << sentence;
    }
}



namespace
{
  constexpr double west = 14.25, south = 67., extent = 0.25;

  const Point<2> middle_of_map = transverse_mercator({14.375, 67.125}, 33);

  const std::string utm_33n = "EPSG:32633";



  /// Place @p x of one coordinate system in another.
  Point<2>
  transformed(const Point<2> &x, const std::string &from, const std::string &to)
  {
    std::vector<Point<2>> places = {x};
    MapTransformation(from, to).transform(places);
    return places[0];
  }



  using Function = std::function<double(const Point<2> &)>;

  /// n x n cells, whose centres have the values of @p height at their places on
  /// the map.
  Raster
  in_degrees(const unsigned int n, const Function &height)
  {
    Raster raster;
    raster.n_columns = raster.n_rows = n;
    raster.dx = raster.dy = extent / n;
    raster.west           = west;
    raster.south          = south;
    for (unsigned int r = 0; r < n; ++r)
      for (unsigned int i = 0; i < n; ++i)
        raster.values.push_back(
          height(transverse_mercator({raster.x(i), raster.y(r)}, 33)));
    return raster;
  }



  double
  plane(const Point<2> &x)
  {
    return -1200. + 0.1 * (x[0] - middle_of_map[0]) -
           0.07 * (x[1] - middle_of_map[1]);
  }



  /// Waves of 6 km, 1 m high.
  double
  waves(const Point<2> &x)
  {
    return std::sin(x[0] / 955.) * std::cos(x[1] / 955.);
  }



  /// The largest error of a raster within @p radius of the middle_of_map, m.
  double
  largest_error(const Raster   &raster,
                const Function &height,
                const double    radius)
  {
    double       result = 0.;
    unsigned int n      = 0;
    for (unsigned int r = 0; r < raster.n_rows; ++r)
      for (unsigned int i = 0; i < raster.n_columns; ++i)
        if (const Point<2> x(raster.x(i), raster.y(r));
            x.distance(middle_of_map) < radius)
          {
            const double difference = std::abs(raster.value(i, r) - height(x));
            EXPECT_FALSE(std::isnan(difference));
            result = std::max(result, difference);
            ++n;
          }
    EXPECT_GT(n, 200u);
    return result;
  }
} // namespace



// In the zone, at its edges and beyond, in both hemispheres.
TEST(MapTransformation, IsKruegersSeries)
{
  for (const int zone : {33, -1, -60})
    {
      const unsigned int    number   = std::abs(zone);
      const bool            is_south = zone < 0;
      std::vector<Point<2>> places, expected;
      for (double lon = -6.; lon <= 6.; lon += 1.5)
        for (double lat = 1.; lat < 84.; lat += 7.)
          {
            places.emplace_back(6. * number - 183. + lon,
                                is_south ? -lat : lat);
            expected.push_back(
              transverse_mercator(places.back(), number, is_south));
          }
      MapTransformation(wgs_84,
                        map_code("",
                                 text("UTM ", number, is_south ? 'S' : 'N')))
        .transform(places);
      for (std::size_t i = 0; i < places.size(); ++i)
        EXPECT_LT(places[i].distance(expected[i]), 1e-6)
          << zone << ' ' << expected[i];
    }
}



// A degree of a meridian and of the equator.
TEST(MapTransformation, LengthsOnEarth)
{
  const auto lengths = lengths_on_earth(
    {{0., -0.5}, {0., 0.5}, {10., 0.}, {11., 0.}, {0., 95.}, {0., 0.}}, wgs_84);
  ASSERT_EQ(lengths.size(), 3u);
  EXPECT_NEAR(lengths[0], 110574.39, 2.);
  EXPECT_NEAR(lengths[1], 111319.49, 2.);
  EXPECT_FALSE(std::isfinite(lengths[2]));
  EXPECT_NEAR(lengths_on_earth({{5e5, 7e6}, {5e5, 7.001e6}}, utm_33n)[0],
              1000. / 0.9996,
              1e-4);
}



TEST(MapTransformation, PlacesThatAreNone)
{
  EXPECT_FALSE(std::isfinite(transformed({0., 95.}, wgs_84, utm_33n).norm()));
  EXPECT_NE(error([] {
              MapTransformation("somewhere", utm_33n);
            }).find("no transformation from the coordinate system 'somewhere'"),
            std::string::npos);
}



// By code and by words; zone 33 has the central meridian 15 degrees east.
TEST(CoordinateSystem, WordsForGis)
{
  const std::string words = well_known_text(utm_33n);
  EXPECT_EQ(words.rfind("PROJCS[\"WGS_1984_UTM_Zone_33N\"", 0), 0u) << words;
  EXPECT_NE(words.find("PARAMETER[\"Central_Meridian\",15.0]"),
            std::string::npos)
    << words;
  EXPECT_EQ(well_known_text(words), words);
  EXPECT_EQ(well_known_text("PROJCS[\"of the user\"]"),
            "PROJCS[\"of the user\"]");
  EXPECT_EQ(well_known_text(""), "");
  EXPECT_EQ(well_known_text("EPSG:1"), "");
}



TEST(CoordinateSystem, Units)
{
  for (const auto &[words, unit] :
       {std::make_pair(utm_33n, MapUnit::metres),
        std::make_pair(well_known_text(utm_33n), MapUnit::metres),
        std::make_pair(std::string("urn:ogc:def:crs:EPSG::32633"),
                       MapUnit::metres),
        std::make_pair(wgs_84, MapUnit::degrees),
        std::make_pair(well_known_text(wgs_84), MapUnit::degrees),
        std::make_pair(std::string("EPSG:2263"), MapUnit::other), // feet
        std::make_pair(std::string("EPSG:1234567"), MapUnit::unknown),
        std::make_pair(std::string("/etc/hosts"), MapUnit::unknown),
        std::make_pair(std::string(), MapUnit::unknown)})
    EXPECT_EQ(map_unit(words), unit) << words;
}



// Half a cell of 190 m off, it would be wrong by 9 m.
TEST(ProjectRaster, PlaneOfTheMap)
{
  const Raster raster =
    project_raster(in_degrees(120, plane), utm_33n, 0., "'Projection'");
  EXPECT_LT(largest_error(raster, plane, 4e3), 1e-7);
  // The outermost cells, where differences are one-sided, and all others.
  unsigned int n_known = 0;
  for (unsigned int r = 0; r < raster.n_rows; ++r)
    for (unsigned int i = 0; i < raster.n_columns; ++i)
      if (const double value = raster.value(i, r); !std::isnan(value))
        {
          ++n_known;
          ASSERT_NEAR(value, plane({raster.x(i), raster.y(r)}), 1e-3);
        }
  EXPECT_GT(n_known, 0.95 * raster.n_columns * raster.n_rows);
}



// By default the width of the raster's cells on the map: the smaller side,
// 0.25/120 degrees at 67.125 degrees north; otherwise the requested width.
TEST(ProjectRaster, CellsOfTheMap)
{
  const Raster degrees = in_degrees(120, plane);
  const Raster own     = project_raster(degrees, utm_33n, 0., "'Projection'");
  const double width =
    transverse_mercator({14.375 + 0.5 * degrees.dx, 67.125}, 33)
      .distance(transverse_mercator({14.375 - 0.5 * degrees.dx, 67.125}, 33));
  EXPECT_NEAR(own.dx, width, 1e-6);
  EXPECT_EQ(own.dx, own.dy);
  const Raster asked = project_raster(degrees, utm_33n, 100., "'Projection'");
  EXPECT_EQ(asked.dx, 100.);
  EXPECT_EQ(std::fmod(asked.west, 100.), 0.);
  EXPECT_EQ(std::fmod(asked.south, 100.), 0.);
  // All of the raster is covered, and not a row more.
  for (const double lat : {south, south + extent})
    for (const double lon : {west, west + extent})
      {
        const Point<2> x = transverse_mercator({lon, lat}, 33);
        EXPECT_GE(x[0], asked.west);
        EXPECT_GE(x[1], asked.south);
        EXPECT_LE(x[0], asked.west + asked.n_columns * asked.dx);
        EXPECT_LE(x[1], asked.south + asked.n_rows * asked.dy);
      }
  EXPECT_LT(largest_error(asked, plane, 4e3), 1e-7);
}



// The error of the cubic surface falls with the third power at least.
TEST(ProjectRaster, Converges)
{
  const auto error_on = [](const unsigned int n) {
    return largest_error(
      project_raster(in_degrees(n, waves), utm_33n, 90., "'Projection'"),
      waves,
      4e3);
  };
  const double coarse = error_on(60), fine = error_on(120);
  EXPECT_LT(fine, 5e-4);
  EXPECT_GT(coarse / fine, 7.);
}



TEST(ProjectRaster, LongitudesUpTo360)
{
  Raster east = in_degrees(30, plane);
  // The same places west of Greenwich, once as negative numbers.
  east.west -= 30.;
  Raster beyond = east;
  beyond.west += 360.;
  const Raster a = project_raster(east, "EPSG:32628", 300., "");
  const Raster b = project_raster(beyond, "EPSG:32628", 300., "");
  EXPECT_EQ(a.west, b.west);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (unsigned int i = 0; i < a.values.size(); ++i)
    if (!std::isnan(a.values[i]) && !std::isnan(b.values[i]))
      {
        ASSERT_NEAR(a.values[i], b.values[i], 1e-6);
      }
}



TEST(ProjectRaster, CellsWithoutData)
{
  Raster degrees               = in_degrees(60, plane);
  degrees.nodata               = -32768.;
  degrees.values[30 * 60 + 30] = std::numeric_limits<double>::quiet_NaN();
  const Raster raster = project_raster(degrees, utm_33n, 0., "'Projection'");
  EXPECT_EQ(raster.nodata, -32768.);
  unsigned int n_missing = 0;
  for (unsigned int r = 0; r < raster.n_rows; ++r)
    for (unsigned int i = 0; i < raster.n_columns; ++i)
      if (Point<2>(raster.x(i), raster.y(r)).distance(middle_of_map) < 2e3)
        {
          const double value = raster.value(i, r);
          n_missing += std::isnan(value);
          if (!std::isnan(value))
            {
              ASSERT_NEAR(value, plane({raster.x(i), raster.y(r)}), 0.02);
            }
        }
  // Two by two cells around the one that is missing, in cells of half the size.
  EXPECT_GT(n_missing, 0u);
  EXPECT_LT(n_missing, 16u);
}



// What is in metres of zone 33 already comes to zone 32 as what is in degrees.
TEST(ProjectRaster, FromAnotherMap)
{
  Raster raster;
  raster.n_columns = raster.n_rows = 60;
  raster.dx = raster.dy    = 200.;
  raster.west              = middle_of_map[0] - 6e3;
  raster.south             = middle_of_map[1] - 6e3;
  raster.coordinate_system = utm_33n;
  for (unsigned int r = 0; r < 60; ++r)
    for (unsigned int i = 0; i < 60; ++i)
      raster.values.push_back(plane({raster.x(i), raster.y(r)}));
  const Raster in_32 = project_raster(raster, "EPSG:32632", 0., "'Projection'");
  EXPECT_EQ(in_32.coordinate_system, "EPSG:32632");
  std::vector<Point<2>> places;
  for (unsigned int r = 0; r < in_32.n_rows; ++r)
    for (unsigned int i = 0; i < in_32.n_columns; ++i)
      places.emplace_back(in_32.x(i), in_32.y(r));
  MapTransformation("EPSG:32632", utm_33n).transform(places);
  unsigned int n_known = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    if (!std::isnan(in_32.values[i]))
      {
        ++n_known;
        ASSERT_NEAR(in_32.values[i], plane(places[i]), 1e-6);
      }
  EXPECT_GT(n_known, 3000u);
}



TEST(ProjectRaster, RefusesWhatIsNotInDegrees)
{
  Raster metres              = in_degrees(30, plane);
  metres.south               = 6.5e6;
  const std::string sentence = error(
    [&] { project_raster(metres, utm_33n, 0., "'Projection' = UTM 33N"); });
  EXPECT_NE(sentence.find("'Projection' = UTM 33N is set for a raster that"),
            std::string::npos)
    << sentence;
}



TEST(ProjectRaster, RefusesMapsThatAreNotTrue)
{
  const Raster degrees = in_degrees(30, plane);
  for (const std::string map : {"EPSG:32640", "EPSG:3857"})
    {
      const std::string sentence = error([&] {
        project_raster(degrees, map, 0., "'Surfaces/bed/Projection' = " + map);
      });
      EXPECT_NE(sentence.find("lengths would be wrong by"), std::string::npos)
        << sentence;
      EXPECT_NE(sentence.find("UTM 33N"), std::string::npos) << sentence;
    }
  const std::string sentence =
    error([&] { project_raster(degrees, utm_33n, 0.1, "'Projection'"); });
  EXPECT_NE(sentence.find("Choose larger cells"), std::string::npos)
    << sentence;
}



// The part of a large raster gives the same surface at the mesh as the whole,
// also where longitudes count from 0 to 360.
TEST(PartAround, SurfaceAtTheMeshIsThatOfTheWhole)
{
  Raster       whole = in_degrees(2100, waves);
  const Box<2> mesh{Point<2>(middle_of_map - Point<2>(300., 200.)),
                    middle_of_map + Point<2>(300., 200.)};
  for (const double turn : {0., 360.})
    {
      whole.west        = west + turn;
      const Raster part = part_around(whole, mesh, utm_33n);
      EXPECT_LT(part.n_columns * part.n_rows, 100000u);
      Raster read = part;
      read.values.clear();
      const int column = std::lround((part.west - whole.west) / whole.dx);
      const int row    = whole.n_rows - part.n_rows -
                      std::lround((part.south - whole.south) / whole.dy);
      for (unsigned int r = 0; r < part.n_rows; ++r)
        for (unsigned int i = 0; i < part.n_columns; ++i)
          read.values.push_back(whole.value(column + i, row + r));
      const HeightField all(whole), cut(read);
      for (const double x : {-300., 0., 300.})
        for (const double y : {-200., 0., 200.})
          {
            Point<2> place =
              transformed(middle_of_map + Point<2>(x, y), utm_33n, wgs_84);
            place[0] += turn;
            ASSERT_TRUE(cut.at(place));
            EXPECT_NEAR(cut.at(place)->height, all.at(place)->height, 1e-9);
          }
    }
}
