// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/terrain/surfaces.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "core_setup.h"

// Shape, log and remarks of a pipe read the same route: the file is read once,
// so that the corners are the same for all and belong to the checksum.
TEST(Routes, FileIsReadOnce)
{
  using namespace talus;
  using dealii::Point;
  const auto folder = std::filesystem::temp_directory_path() /
                      ("talus-routes-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string &corners) {
    std::ofstream(folder / "pipe.geojson")
      << R"({"type": "FeatureCollection", "crs": {"type": "name", )"
         R"("properties": {"name": "urn:ogc:def:crs:EPSG::32633"}}, )"
         R"("features": [{"type": "Feature", "geometry": )"
         R"({"type": "LineString", "coordinates": [)"
      << corners << "]}}]}";
  };
  FreshParameters fresh;
  Surfaces<3>     surfaces({});
  dealii::ParameterAcceptor::declare_all_parameters();
  dealii::ParameterAcceptor::parse_all_parameters();
  const Constants constants;
  surfaces.prepare(constants, folder, Point<3>(), {});
  const std::vector<Point<2>> expected = {{1e5, 2e5}, {1.1e5, 2.2e5}};
  write("[100000, 200000], [110000, 220000]");
  EXPECT_EQ(surfaces.read_route("'Route'", "pipe.geojson"), expected);
  write("[0, 0], [1, 1]");
  EXPECT_EQ(surfaces.read_route("'Route'", "pipe.geojson"), expected);
  // A new preparation reads anew.
  surfaces.prepare(constants, folder, Point<3>(), {});
  EXPECT_NE(surfaces.read_route("'Route'", "pipe.geojson"), expected);
  std::filesystem::remove_all(folder);
}
