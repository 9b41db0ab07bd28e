// SPDX-License-Identifier: LGPL-2.1-or-later
// stations.csv, lines.csv and maps.csv of a block, by hand.

#include <talus/maps/lines.h>
#include <talus/maps/maps.h>
#include <talus/maps/stations.h>

#include "../whole_problem.h"
#include "observers_setup.h"

namespace map_tables_test
{
  using namespace talus;

  struct Settings
  {
    std::shared_ptr<MapSettings>    maps = std::make_shared<MapSettings>();
    std::shared_ptr<StationList<2>> stations =
      std::make_shared<StationList<2>>();
  };



  /// A block 1 m high from x = 2 to 4 m, with the velocity (3, 4) m/s.
  struct MapTables : ObserversTest
  {
    MapTables()
      : block("set Initial velocity = 3; 4\n",
              in_section("Stations",
                         "set Points = on: 3 | beside: 7\n"
                         "set Lines = pipe: 3; 4.5\n"
                         "set Drag coefficient = 2\n"
                         "set Bearing factor = 10\n") +
                in_section("Maps",
                           "set Write = true\n"
                           "set Arrival thresholds = 0.2, 0.8") +
                in_section("Excess pore pressure",
                           "set Initial = 0.6*overburden"))
    {
      settings.folder = folder;
    }

    /// Rows of a table by heading.
    std::vector<std::map<std::string, std::string>>
    table(const std::string &name) const
    {
      const auto fields = [](const std::string &line) {
        std::vector<std::string> result;
        std::istringstream       in(line + ",");
        for (std::string field; std::getline(in, field, ',');)
          result.push_back(field);
        return result;
      };
      const auto text     = lines(name);
      const auto headings = fields(text.at(0));
      std::vector<std::map<std::string, std::string>> rows;
      for (unsigned int i = 1; i < text.size(); ++i)
        {
          const auto row = fields(text[i]);
          EXPECT_EQ(row.size(), headings.size()) << text[i];
          rows.emplace_back();
          for (unsigned int c = 0; c < row.size(); ++c)
            rows.back()[headings[c]] = row[c];
        }
      return rows;
    }

    void
    observe(Observer<2> &observer)
    {
      observer.check(block);
      observer.begin(settings, block, Beginning::fresh);
      observer.start(block);
      observer.observe(block);
    }

    /// Move the block by @p distance, m, in a step of 1 s.
    void
    move(const double distance)
    {
      for (unsigned int p = 0; p < block.points.size(); ++p)
        block.points.data(block.points.position)[p] += distance;
      block.sort();
      block.time += 1.;
      ++block.step;
    }

    static void
    expect(const std::map<std::string, std::string> &row,
           const std::string                        &heading,
           const double                              value)
    {
      ASSERT_EQ(row.count(heading), 1u) << heading;
      EXPECT_NEAR(std::stod(row.at(heading)), value, 1e-9 * (1. + value))
        << heading;
    }

    WholeProblem<Settings> block;
    OutputSettings         settings;
  };
} // namespace map_tables_test



using map_tables_test::MapTables;

TEST_F(MapTables, Stations)
{
  using namespace map_tables_test;
  Stations<2> stations(block.problem, block.observed.stations);
  observe(stations);
  const auto row = table("stations.csv").at(0);
  expect(row, "on thickness [m]", 1.);
  expect(row, "on depth-mean velocity x [m/s]", 3.);
  expect(row, "on depth-mean velocity y [m/s]", 4.);
  expect(row, "on flux [m^2/s]", 5.);
  expect(row, "on momentum flux [N/m]", 2000. * 25.);
  expect(row, "on shear strength [Pa]", 5000.);
  expect(row, "on impact pressure [Pa]", 0.5 * 2. * 2000. * 25. + 50000.);
  expect(row, "on largest pore pressure ratio [-]", 0.6);
  expect(row, "on excess pore pressure at the bed [Pa]", 0.6 * 800. * 9.81);
  for (const auto &[heading, value] : row)
    if (heading.find("beside") == 0)
      {
        EXPECT_EQ(value, "0") << heading;
      }
}



// Places each half metre; the one at the end of the block is half covered.
TEST_F(MapTables, Lines)
{
  using namespace map_tables_test;
  Lines<2> lines(block.problem, block.observed.maps, block.observed.stations);
  observe(lines);
  const auto rows = table("lines.csv");
  ASSERT_EQ(rows.size(), 4u);
  const std::vector<double> thickness = {1., 1., 0.5, 0.};
  for (unsigned int i = 0; i < 4; ++i)
    {
      EXPECT_EQ(rows[i].at("line"), "pipe");
      expect(rows[i], "distance [m]", 0.5 * i);
      expect(rows[i], "x [m]", 3. + 0.5 * i);
      expect(rows[i], "thickness at start [m]", thickness[i]);
      expect(rows[i], "maximum thickness [m]", thickness[i]);
      expect(rows[i], "maximum speed [m/s]", i < 3 ? 5. : 0.);
      expect(rows[i], "maximum impact pressure [Pa]", i < 3 ? 1e5 : 0.);
    }
  // Soil that has not arrived has no time of arrival.
  EXPECT_EQ(rows[0].at("arrival time 0.8 m [s]"), "0");
  EXPECT_EQ(rows[2].at("arrival time 0.2 m [s]"), "0");
  EXPECT_EQ(rows[2].at("arrival time 0.8 m [s]"), "");
  EXPECT_EQ(rows[3].at("arrival time 0.2 m [s]"), "");
  EXPECT_EQ(rows[3].at("time of maximum speed [s]"), "");
}



// After 2 m of motion the block covers the columns from 4 to 6 m.
TEST_F(MapTables, MapsInASection)
{
  using namespace map_tables_test;
  Maps<2> maps(block.problem, block.observed.maps);
  ASSERT_TRUE(maps.is_enabled(settings));
  observe(maps);
  move(2.);
  maps.follow(block);
  maps.observe(block);
  const auto rows = table("maps.csv");
  ASSERT_EQ(rows.size(), 8u);
  for (unsigned int i = 0; i < 8; ++i)
    {
      const bool is_left = i < 4;
      expect(rows[i], "x [m]", 2.25 + 0.5 * i);
      expect(rows[i], "ground [m]", 0.);
      expect(rows[i], "final thickness [m]", is_left ? 0. : 1.);
      expect(rows[i], "thickness at start [m]", is_left ? 1. : 0.);
      EXPECT_NEAR(std::stod(rows[i].at("erosion [m]")),
                  is_left ? 1. : -1.,
                  1e-12);
      expect(rows[i], "arrival time 0.8 m [s]", is_left ? 0. : 1.);
      expect(rows[i], "maximum momentum flux [N/m]", 5e4);
      const std::string ratio = "largest pore pressure ratio [-]",
                        u     = "excess pore pressure at the bed [Pa]";
      if (is_left)
        {
          EXPECT_EQ(rows[i].at(ratio) + rows[i].at(u), "");
        }
      else
        {
          expect(rows[i], ratio, 0.6);
          expect(rows[i], u, 0.6 * 800. * 9.81);
        }
    }
}
