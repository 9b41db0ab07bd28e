// SPDX-License-Identifier: LGPL-2.1-or-later
// The landslide of the paper with vertical gravity on a seabed that is inclined
// through the mesh, prm/landslide-inclined.prm, against the same slide on a seabed
// that is a face of the mesh.

#include "case.h"
#include "landslide.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string inclined_file = "landslide-inclined.prm";

  /// Of the foremost centre along a bed turned by @p angle, m: points there are
  /// h/4 above the bed.
  double
  front(const Table &table, const double time, const double angle)
  {
    const double a = angle * M_PI / 180;
    return (table.at(time, "front x [m]") - 0.1 * std::sin(a)) / std::cos(a);
  }



  struct Gate
  {
    double time, tolerance;
  };



  void
  expect_same_slide(Verification            &gates,
                    const Table             &inclined,
                    const Table             &aligned,
                    const double             angle,
                    const std::vector<Gate> &times)
  {
    for (const auto &[time, tolerance] : times)
      gates.near("front [m] at " + std::to_string(int(time)) + " s",
                 front(inclined, time, angle),
                 aligned.at(time, "front x [m]"),
                 tolerance);
    double       empty = 0, bodies = 0, remainder = 0, gain = 0;
    const double work = inclined["gravity work [J]"].back();
    for (unsigned int row = 0; row < inclined.n_rows(); ++row)
      {
        empty  = std::max(empty, inclined["empty interior cells"][row]);
        bodies = std::max(bodies, inclined["connected bodies"][row]);
        const double lost = inclined["energy remainder [J]"][row] / work;
        remainder         = std::max(remainder, lost);
        gain              = std::max(gain, -lost);
      }
    gates.at_most("empty interior cells", empty, 0);
    gates.at_most("connected bodies", bodies, 1, "1");
    gates.at_most("energy lost / final gravity work", remainder, 0.006);
    gates.at_most("energy gained / final gravity work", gain, 2e-4);
  }



  /// What the bed holds and what the soil has, to the last digits: the mass
  /// cut-off of nodes leaves a little.
  void
  expect_momentum_closed(Verification      &gates,
                         const Table       &table,
                         const std::string &folder)
  {
    const Table  forces(std::filesystem::path(TALUS_RESULTS_DIR) / folder /
                       "obstacles.csv");
    const double weight = table["mass [kg]"][0] * 9.81;
    double       worst = 0, below = 0;
    for (unsigned int row = 1; row < table.n_rows(); ++row)
      {
        // Gravity is vertical: along x there is only the bed.
        worst = std::max(worst,
                         std::abs(table["momentum x [kg m/s]"][row] +
                                  forces["bed impulse x [N s]"][row]) /
                           (weight * table["time [s]"][row]));
        below =
          std::max(below, forces["bed share of mass below surface [-]"][row]);
      }
    gates.at_most("momentum that the bed does not account for / (M g t)",
                  worst,
                  1e-6);
    gates.at_most("share of mass below the bed", below, 0.01);
  }



  const Overrides stretched_only = {"Splitting/Directions=stretched"};
} // namespace



TEST(LandslideInclined, RunsAsOnTheFaceOfTheMesh)
{
  const Overrides end = {"End time=10"};
  const Table     aligned =
    run<2>("landslide-quick.prm", "landslide-aligned", stretched_only + end);
  const Table  inclined = run<2>(inclined_file, "landslide-inclined", end);
  Verification gates("Landslide on a seabed turned by 5 degrees, h = 0.4 m",
                     "prm/" + inclined_file,
                     "the same on a face of the mesh");
  expect_same_slide(gates, inclined, aligned, 5, {{5, 0.005}, {10, 0.005}});
  expect_momentum_closed(gates, inclined, "landslide-inclined");
}



TEST(LandslideInclinedFull, ToRest)
{
  const std::vector<Gate> times = {
    {5, 0.005}, {10, 0.005}, {15, 0.005}, {20, 0.008}, {30, 0.01}};
  const Table aligned =
    run<2>("landslide-quick.prm", "landslide-aligned", stretched_only);
  {
    const Table  inclined = run<2>(inclined_file, "landslide-inclined");
    Verification gates("Landslide on a seabed turned by 5 degrees to rest",
                       "prm/" + inclined_file,
                       "the same on a face of the mesh");
    expect_same_slide(gates, inclined, aligned, 5, times);
    expect_momentum_closed(gates, inclined, "landslide-inclined");
  }
  {
    // Turned by 12 degrees, and gravity with it.
    const Table inclined =
      run<2>(inclined_file,
             "landslide-inclined",
             {"Gravity/Slope angle=-7",
              "Grid/Lower corner=-22.4,-44.8",
              "Grid/Upper corner=201.6,12.8",
              "Bodies/slide/Vertices=0,0; 47.5966623,-10.1169829; "
              "40.1654625,-3.4257296; 9.5103167,3.0902228",
              "Obstacles/bed/Normal=0.20791169081775934,0.9781476007338057"});
    Verification gates("Landslide on a seabed turned by 12 degrees to rest",
                       "prm/" + inclined_file + " turned",
                       "the same on a face of the mesh");
    expect_same_slide(gates, inclined, aligned, 12, times);
  }
}



TEST(LandslideInclinedFine, ToRest)
{
  const Overrides fine    = {"Grid/Cell size=0.2"};
  const Table     aligned = run<2>("landslide-quick.prm",
                               "landslide-aligned-fine",
                               stretched_only + fine);
  const Table inclined = run<2>(inclined_file, "landslide-inclined-fine", fine);
  Verification gates(
    "Landslide on a seabed turned by 5 degrees to rest, h = 0.2 m",
    "prm/" + inclined_file,
    "the same on a face of the mesh");
  expect_same_slide(
    gates,
    inclined,
    aligned,
    5,
    {{5, 0.005}, {10, 0.005}, {15, 0.005}, {20, 0.008}, {30, 0.01}});
  expect_momentum_closed(gates, inclined, "landslide-inclined-fine");
}



// Half of a slide 12 m wide, that spreads sideways, too: z = 0 is its middle.
TEST(LandslideInclined3d, SpreadsAsOnTheFaceOfTheMesh)
{
  const Table aligned = run<3>("landslide-3d.prm",
                               "landslide-aligned-3d",
                               {"End time=6",
                                "Grid/Lower corner=-16,0,0",
                                "Grid/Upper corner=96,8,24",
                                "Bodies/slide/Extent in z=0,6",
                                "Bodies/slide/Filling=clipped"});
  const Table inclined =
    run<3>("landslide-inclined-3d.prm", "landslide-inclined-3d");
  Verification gates("Landslide in 3-D on a seabed turned by 5 degrees, "
                     "h = 0.8 m",
                     "tests/cases/landslide-inclined-3d.prm",
                     "the same on a face of the mesh");
  expect_same_slide(gates, inclined, aligned, 5, {{3, 0.005}, {6, 0.005}});
  gates.near("mean distance from the middle [m] at 6 s",
             inclined.at(6, "centre z [m]"),
             aligned.at(6, "centre z [m]"),
             0.005);
  expect_momentum_closed(gates, inclined, "landslide-inclined-3d");
}
