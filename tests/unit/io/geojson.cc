// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/geojson.h>

#include <gtest/gtest.h>

#include <fstream>

#include "core_setup.h"

using namespace talus;
using dealii::Point;

// A namespace of its own: several files are compiled as one.
namespace geojson_test
{
  namespace
  {
    const std::filesystem::path file = "outline.geojson";

    const std::string ring = "[[15.1, 41], [15.2, 41, 7], [15.2, 41.1], "
                             "[15.1, 41]]";

    GeojsonPolygon
    read(const std::string &text)
    {
      std::ofstream(file) << text;
      return read_geojson_polygon(file);
    }

    std::string
    polygon(const std::string &rings)
    {
      return R"({"type": "Polygon", "coordinates": [)" + rings + "]}";
    }

    std::string
    features(const std::string &geometries, const std::string &more = "")
    {
      return R"({"type": "FeatureCollection", )" + more +
             R"("features": [{"type": "Feature", "geometry": )" + geometries +
             "}]}";
    }

    void
    expect_refused(const std::string &text, const std::string &words)
    {
      const std::string message = message_of<ExcUser>([&]() { read(text); });
      EXPECT_NE(message.find(words), std::string::npos) << text << message;
    }
  } // namespace



  TEST(Geojson, PolygonOfAFeature)
  {
    for (const std::string &text :
         {polygon(ring),
          features(polygon(ring)),
          features(R"({"type": "MultiPolygon", "coordinates": [[)" + ring +
                   "]]}")})
      {
        const GeojsonPolygon outline = read(text);
        ASSERT_EQ(outline.corners.size(), 3u) << text;
        EXPECT_EQ(outline.corners[1], Point<2>(15.2, 41.));
        EXPECT_TRUE(outline.is_in_degrees);
      }
  }



  TEST(Geojson, OnAMap)
  {
    const auto crs = [](const std::string &name) {
      return R"("crs": {"type": "name", "properties": {"name": ")" + name +
             R"("}}, )";
    };
    EXPECT_FALSE(
      read(features(polygon(ring), crs("urn:ogc:def:crs:EPSG::32633")))
        .is_in_degrees);
    EXPECT_TRUE(
      read(features(polygon(ring), crs("urn:ogc:def:crs:OGC:1.3:CRS84")))
        .is_in_degrees);
  }



  TEST(Geojson, RefusesWhatIsNoOutline)
  {
    expect_refused("{", "cannot be read");
    expect_refused("{}", "has 0 polygons");
    expect_refused(features(R"({"type": "Point", "coordinates": [1, 2]})"),
                   "has 0 polygons");
    expect_refused(R"({"type": "MultiPolygon", "coordinates": [[)" + ring +
                     "], [" + ring + "]]}",
                   "has 2 polygons");
    expect_refused(polygon(ring + ", " + ring), "2 rings");
    expect_refused(polygon(R"([[1, "a"], [2, 3]])"), "cannot be read");
    expect_refused(polygon("[[1], [2, 3]]"), "less than two numbers");
  }



  TEST(Geojson, LineOfAFeature)
  {
    const std::string line =
      R"({"type": "LineString", "coordinates": [[15.1, 41], [15.2, 41, 7]]})";
    for (const std::string &text : {line, features(line)})
      {
        std::ofstream(file) << text;
        const GeojsonLine read = read_geojson_line(file);
        EXPECT_EQ(read.corners,
                  (std::vector<Point<2>>{{15.1, 41.}, {15.2, 41.}}));
        EXPECT_TRUE(read.is_in_degrees);
      }
    std::ofstream(file) << polygon(ring);
    const std::string message =
      message_of<ExcUser>([&]() { read_geojson_line(file); });
    EXPECT_TRUE(contains(message, "has 0 lines, where one was expected"))
      << message;
  }
} // namespace geojson_test
