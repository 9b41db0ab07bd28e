// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of the sections Maps, Stations and Runout.

#include <talus/maps/map_settings.h>
#include <talus/maps/runout.h>
#include <talus/maps/station_list.h>

#include "core_setup.h"

namespace map_settings_test
{
  using namespace talus;
  using dealii::Point;

  const Box<3>   domain{Point<3>(0., -5., 0.), Point<3>(100., 20., 50.)};
  const Point<3> origin(512000., 6742800., -300.);

  /// Settings with the entries of one section.
  template <typename Settings>
  struct Parsed : FreshParameters
  {
    Parsed(const std::string &section, const std::string &entries)
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        in_section(section, entries));
      ParameterAcceptor::parse_all_parameters();
    }

    Settings settings;
  };



  template <typename Action>
  void
  expect_refused(const Action &action, const std::string &part)
  {
    const std::string said = message_of<ExcUser>(action);
    EXPECT_TRUE(contains(said, part)) << said;
  }
} // namespace map_settings_test



TEST(MapSettings, ThicknessesByDefaultAreATenthOfACell)
{
  using namespace map_settings_test;
  {
    const Parsed<MapSettings> maps("Maps", "");
    EXPECT_FALSE(maps.settings.is_enabled());
    EXPECT_EQ(maps.settings.motion_between_samples(), 0.1);
    EXPECT_DOUBLE_EQ(maps.settings.smallest_thickness(4.), 0.4);
    EXPECT_EQ(maps.settings.arrival_thresholds(4.),
              std::vector<double>{maps.settings.smallest_thickness(4.)});
    EXPECT_EQ(maps.settings.n_arrival_thresholds(), 1u);
  }
  const Parsed<MapSettings> maps("Maps",
                                 "set Smallest thickness = 0.25\n"
                                 "set Arrival thresholds = 0.5, 2");
  EXPECT_EQ(maps.settings.smallest_thickness(4.), 0.25);
  EXPECT_EQ(maps.settings.arrival_thresholds(4.),
            (std::vector<double>{0.5, 2.}));
  EXPECT_NO_THROW(maps.settings.check(2.));
  expect_refused([&]() { maps.settings.check(1.9); },
                 "'Maps/Arrival thresholds' is 2 m, which soil in a mesh 1.9 m "
                 "high cannot reach");
  expect_refused([&]() { maps.settings.check(0.2); },
                 "'Maps/Smallest thickness' is 0.25 m");
}



TEST(MapSettings, ThresholdsOnce)
{
  using namespace map_settings_test;
  const Parsed<MapSettings> maps("Maps", "set Arrival thresholds = 1, 2, 1");
  expect_refused([&]() { maps.settings.check(10.); }, "lists 1 m twice");
}



// y of places is the bottom of the mesh; on the map z runs to the south.
TEST(StationList, PlacesInTheMeshAndOnTheMap)
{
  using namespace map_settings_test;
  for (const bool on_map : {false, true})
    {
      const Parsed<StationList<3>> list(
        "Stations",
        on_map ? "set Coordinates = map\n"
                 "set Points = well : 512010, 6742780 | pier: 512100, 6742750\n"
                 "set Lines = pipe: 512000, 6742800; 512003, 6742796\n"
                 "set Width = 3"
               : "set Points = well : 10, 20 | pier: 100, 50\n"
                 "set Lines = pipe: 0, 0; 3, 4");
      const auto points = list.settings.points(domain, origin);
      ASSERT_EQ(points.size(), 2u);
      EXPECT_EQ(points[0].name, "well");
      EXPECT_LT(points[0].corners.at(0).distance(Point<3>(10., -5., 20.)),
                1e-8);
      EXPECT_LT(points[1].corners.at(0).distance(Point<3>(100., -5., 50.)),
                1e-8);
      const auto lines = list.settings.lines(domain, origin);
      ASSERT_EQ(lines.size(), 1u);
      ASSERT_EQ(lines[0].corners.size(), 2u);
      EXPECT_NEAR(lines[0].corners[0].distance(lines[0].corners[1]), 5., 1e-8);
      EXPECT_EQ(list.settings.width(2.), on_map ? 3. : 2.);
    }
}



TEST(StationList, MistakesAreRefused)
{
  using namespace map_settings_test;
  const auto expect = [](const std::string &entries, const std::string &part) {
    const Parsed<StationList<3>> list("Stations", entries);
    expect_refused(
      [&]() {
        list.settings.points(domain, origin);
        list.settings.lines(domain, origin);
      },
      part);
  };
  expect("set Points = 10, 20", "where 'name: place' was expected");
  expect("set Points = a, b: 10, 20", "neither comma nor quotation mark");
  expect("set Points = a: 10", "two numbers, x and z, were expected");
  expect("set Points = a: 10, 20 | a: 11, 20", "two entries of the name 'a'");
  expect("set Points = a: 101, 20", "'a' has a place '101, 20' outside of the");
  expect("set Points = a: 10, 20; 11, 20", "has 2 places, where one was");
  expect("set Lines = a: 10, 20; 10, 20", "'a' has no length");
  expect("set Width = 101", "'Stations/Width' is 101 m, on a mesh that is 100");
}



TEST(RunoutSettings, CornersOfThePath)
{
  using namespace map_settings_test;
  {
    const Parsed<RunoutSettings> runout("Runout",
                                        "set Path = 1, 2; 4, 6; 4, 7");
    EXPECT_EQ(runout.settings.corners(3, origin),
              (std::vector<Point<2>>{{1., 2.}, {4., 6.}, {4., 7.}}));
    EXPECT_DOUBLE_EQ(runout.settings.smallest_thickness(3.), 0.3);
    expect_refused([&]() { runout.settings.corners(2, origin); },
                   "the simulation is two-dimensional");
  }
  const auto expect = [](const std::string &path, const std::string &part) {
    const Parsed<RunoutSettings> runout("Runout", "set Path = " + path);
    expect_refused([&]() { runout.settings.corners(3, origin); }, part);
  };
  expect("1, 2", "has one corner only, '1, 2'");
  expect("1, 2; 1, 2", "has the corner '1, 2' twice in succession");
  expect("1; 2", "two numbers, x and z, were expected");
  // A path that is empty is the path of the centre of mass.
  EXPECT_TRUE(
    Parsed<RunoutSettings>("Runout", "").settings.corners(2, origin).empty());
}
