// SPDX-License-Identifier: LGPL-2.1-or-later
// Outlines of areas in plan in files of vectors.

#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/map_outline.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>

#include "core_setup.h"

using namespace talus;
using dealii::Point;

// A namespace of its own: several files are compiled as one.
namespace map_outline_test
{
  namespace
  {
    const std::filesystem::path file = "outline.geojson";

    const std::string ring = "[[15.1, 41], [15.2, 41, 7], [15.2, 41.1], "
                             "[15.1, 41]]";

    MapCorners
    read(const std::string &text)
    {
      std::ofstream(file) << text;
      return read_outlines(file);
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



  TEST(Geojson, LineOfAFeature)
  {
    const std::string line =
      R"({"type": "LineString", "coordinates": [[15.1, 41], [15.2, 41, 7]]})";
    for (const std::string &text : {line, features(line)})
      {
        std::ofstream(file) << text;
        const MapCorners read = read_line(file);
        EXPECT_EQ(read.parts[0],
                  (std::vector<Point<2>>{{15.1, 41.}, {15.2, 41.}}));
        EXPECT_EQ(map_unit(read.coordinate_system), MapUnit::degrees);
      }
    std::ofstream(file) << polygon(ring);
    const std::string message = message_of<ExcUser>([&]() { read_line(file); });
    EXPECT_NE(message.find("has 0 lines, where one was expected"),
              std::string::npos)
      << message;
  }



  TEST(Geojson, PolygonOfAFeature)
  {
    for (const std::string &text :
         {polygon(ring),
          features(polygon(ring)),
          features(R"({"type": "MultiPolygon", "coordinates": [[)" + ring +
                   "]]}")})
      {
        const MapCorners outline = read(text);
        ASSERT_EQ(outline.parts[0].size(), 3u) << text;
        EXPECT_EQ(outline.parts[0][1], Point<2>(15.2, 41.));
        EXPECT_EQ(map_unit(outline.coordinate_system), MapUnit::degrees);
      }
  }



  TEST(Geojson, NumberOfEachPolygon)
  {
    const auto feature = [](const std::string &number) {
      return R"({"type": "Feature", "properties": {"depth": )" + number +
             R"(}, "geometry": )" + polygon(ring) + "}";
    };
    const auto collection = [](const std::string &all) {
      return R"({"type": "FeatureCollection", "features": [)" + all + "]}";
    };
    std::ofstream(file) << collection(feature("2.5") + "," + feature("1e1"));
    const MapCorners outlines = read_outlines(file, "depth");
    EXPECT_EQ(outlines.parts.size(), 2u);
    EXPECT_EQ(outlines.numbers, (std::vector<double>{2.5, 10.}));
    EXPECT_TRUE(read_outlines(file).numbers.empty());
    for (const std::string &bad :
         {feature("2") + "," + feature("null"),
          feature(R"("deep")"),
          R"({"type": "Feature", "geometry": )" + polygon(ring) + "}"})
      {
        std::ofstream(file) << collection(bad);
        EXPECT_NE(message_of<ExcUser>([&]() {
                    read_outlines(file, "depth");
                  }).find("a polygon without a number in the field 'depth'"),
                  std::string::npos)
          << bad;
      }
  }



  TEST(Geojson, OnAMap)
  {
    const auto crs = [](const std::string &name) {
      return R"("crs": {"type": "name", "properties": {"name": ")" + name +
             R"("}}, )";
    };
    for (const auto &[name, system] :
         {std::make_pair("urn:ogc:def:crs:EPSG::32633", "EPSG:32633"),
          std::make_pair("urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326")})
      EXPECT_EQ(well_known_text(
                  read(features(polygon(ring), crs(name))).coordinate_system),
                well_known_text(system));
    expect_refused(features(polygon(ring), crs("nowhere")),
                   "has the coordinate system 'nowhere'");
  }



  TEST(Geojson, RefusesWhatIsNoOutline)
  {
    expect_refused("{", "cannot be read");
    expect_refused("{}", "cannot be read");
    expect_refused(features(R"({"type": "Point", "coordinates": [1, 2]})"),
                   "has no polygon");
    expect_refused(polygon(ring + ", " + ring), "2 rings");
    expect_refused(polygon(R"([[1, "a"], [2, 3]])"), "cannot be read");
    expect_refused(polygon("[[1], [2, 3]]"), "cannot be read");
  }



  namespace
  {
    const std::string wgs_84_words =
      "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\","
      "6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],"
      "UNIT[\"Degree\",0.0174532925199433]]";

    const std::vector<Point<2>> triangle = {{15.1, 41.},
                                            {15.1, 41.1},
                                            {15.2, 41.}};



    /// Appends numbers byte by byte.
    class Bytes
    {
    public:
      template <typename... Numbers>
      Bytes &
      add(const Numbers... numbers)
      {
        (content.append(reinterpret_cast<const char *>(&numbers),
                        sizeof(numbers)),
         ...);
        return *this;
      }

      template <typename... Numbers>
      Bytes &
      add_big_endian(const Numbers... numbers)
      {
        for (const std::uint32_t n : {std::uint32_t(numbers)...})
          for (const int shift : {24, 16, 8, 0})
            content += char(n >> shift);
        return *this;
      }

      std::string content;
    };



    /// Write a shapefile of @p n equal triangles, as Esri's description has it
    /// (1998): the shapes, the index, and what coordinate system they are in.
    void
    write_shapefile(const std::filesystem::path &path,
                    const int                    n,
                    const std::string           &system)
    {
      Bytes box, shape;
      box.add(15.1, 41., 15.2, 41.1);
      shape.add(5).content += box.content;
      shape.add(1, 4, 0);
      for (const unsigned int corner : {0, 1, 2, 0})
        shape.add(triangle[corner][0], triangle[corner][1]);
      const int  n_words = shape.content.size() / 2;
      const auto head    = [&](const int length) {
        Bytes bytes;
        bytes.add_big_endian(9994, 0, 0, 0, 0, 0, 50 + n * length);
        bytes.add(1000, 5).content += box.content;
        return bytes.add(0., 0., 0., 0.);
      };
      Bytes shapes = head(n_words + 4), index = head(4);
      for (int i = 0; i < n; ++i)
        {
          index.add_big_endian(50 + i * (n_words + 4), n_words);
          shapes.add_big_endian(i + 1, n_words).content += shape.content;
        }
      auto       file  = path;
      const auto write = [&](const char *end, const std::string &content) {
        std::ofstream(file.replace_extension(end), std::ios::binary) << content;
      };
      write(".shp", shapes.content);
      write(".shx", index.content);
      write(".prj", system);
    }



    std::string
    kml(const std::string &inner)
    {
      return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>"
             "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document>"
             "<Placemark><Polygon><outerBoundaryIs><LinearRing><coordinates>"
             "15.1,41,0 15.1,41.1,0 15.2,41,0 15.1,41,0"
             "</coordinates></LinearRing></outerBoundaryIs>" +
             inner + "</Polygon></Placemark></Document></kml>";
    }
  } // namespace



  TEST(MapOutline, OfAnyFileOfVectors)
  {
    std::ofstream("area.kml") << kml("");
    write_shapefile("area.shp", 1, wgs_84_words);
    for (const std::string name : {"area.kml", "area.shp"})
      {
        EXPECT_TRUE(is_outline_file(name)) << name;
        const MapCorners outline = read_outlines(name);
        EXPECT_EQ(outline.parts[0], triangle) << name;
        EXPECT_EQ(map_unit(outline.coordinate_system), MapUnit::degrees)
          << name;
      }
    write_shapefile("area.shp", 1, "");
    EXPECT_EQ(read_outlines("area.shp").coordinate_system, "");
    std::ofstream("area.asc")
      << "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n5\n";
    EXPECT_FALSE(is_outline_file("area.asc"));
  }



  TEST(MapOutline, LineOfAnyFileOfVectors)
  {
    std::ofstream("route.kml")
      << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>"
         "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document><Placemark>"
         "<LineString><coordinates>15.1,41,0 15.2,41.1,0</coordinates>"
         "</LineString></Placemark></Document></kml>";
    const MapCorners line = read_line("route.kml");
    EXPECT_EQ(line.parts[0],
              (std::vector<Point<2>>{{15.1, 41.}, {15.2, 41.1}}));
    EXPECT_EQ(map_unit(line.coordinate_system), MapUnit::degrees);
  }



  TEST(MapOutline, RefusesHoles)
  {
    const auto expect_refused_file = [](const std::string &name,
                                        const std::string &words) {
      const std::string message =
        message_of<ExcUser>([&]() { read_outlines(name); });
      EXPECT_NE(message.find(words), std::string::npos) << message;
    };
    write_shapefile("area.shp", 1, "What is this?");
    expect_refused_file("area.shp",
                        "area.prj' has the coordinate system 'What is this?'");
    write_shapefile("area.shp", 0, wgs_84_words);
    expect_refused_file("area.shp", "has no polygon");
    std::ofstream("area.kml") << kml(
      "<innerBoundaryIs><LinearRing><coordinates>15.11,41.01 15.11,41.02 "
      "15.12,41.01 15.11,41.01</coordinates></LinearRing>"
      "</innerBoundaryIs>");
    expect_refused_file("area.kml", "a polygon of 2 rings");
    std::ofstream("area.kml") << "<kml";
    expect_refused_file("area.kml", "cannot be read (");
  }
} // namespace map_outline_test
