// SPDX-License-Identifier: LGPL-2.1-or-later
// The landslide of the paper on cells of 0.4 m, prm/landslide-quick.prm.

#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>

using namespace talus;
using namespace talus::cases;

namespace
{
  const Overrides unsplit_slide = {"Splitting/Enabled=false"};
  const Overrides stretched     = {"Splitting/Directions=stretched",
                                   "Splitting/Shear=ignored"};

  /// Set a parameter to all digits of @p value.
  std::string
  exactly(const std::string &entry, const double value)
  {
    std::ostringstream out;
    out << entry << '=' << std::setprecision(17) << value;
    return out.str();
  }
} // namespace



TEST(LandslideStretched, WhatMustHoldToRest)
{
  Verification gates("Landslide, h = 0.4 m, stretched splitting",
                     "prm/landslide-quick.prm, Splitting/Directions=stretched",
                     "balance of momentum and energy");
  expect_split_landslide(gates, shared_run("slide-stretched"), 0.002);
}



// The slide on cells of a sixth of its height, in seconds. Without splitting it
// tears on smaller cells only, see LandslideUnsplit.
TEST(LandslideCoarse, WithAndWithoutSplitting)
{
  const std::string coarse = "prm/landslide-quick.prm, Grid/Cell size=0.8";
  Verification      split("Landslide, h = 0.8 m, stretched splitting",
                     coarse + ", Splitting/Directions=stretched",
                     "balance of momentum and energy");
  expect_split_landslide(split, shared_run("slide-coarse"), 0.004);
  Verification unsplit("Landslide, h = 0.8 m, unsplit",
                       coarse + ", Splitting/Enabled=false",
                       "balance of momentum and energy");
  const Table  table = run<2>("landslide-quick.prm",
                             "landslide-coarse-unsplit",
                             unsplit_slide + Overrides{"Grid/Cell size=0.8"});
  expect_momentum(unsplit, table);
  expect_energy(unsplit, table, 0.01, 0.005);
  EXPECT_EQ(table["splits"].back(), 0);
}



// In plane strain Tresca's soil, Mohr-Coulomb without friction, flows at the
// same shear stress as von Mises' soil, and undrained, in effective stress, it
// has the same moduli. With K0 = 1 the seabed has the same normal force:
// otherwise water carries the weight from the start, and friction has N - u A.
TEST(LandslideUndrained, MohrCoulombWithoutFriction)
{
  Verification gates("Landslide, h = 0.8 m, undrained, phi = 0, c = s_u",
                     "prm/landslide-quick.prm, Grid/Cell size=0.8, K0=1, "
                     "Materials/clay/Law=Mohr-Coulomb, undrained, nu = 0.3",
                     "the same with von Mises, nu = 0.49");
  const auto   slide = [](const std::string &name, const Overrides &soil) {
    return run<2>("landslide-quick.prm",
                  "landslide-undrained-" + name,
                  stretched +
                    Overrides{"Grid/Cell size=0.8", "Bodies/slide/K0=1"} +
                    soil);
  };
  const Table total = slide("total", {});
  const Table tresca =
    slide("effective",
          {"Materials/Names=clay, tresca",
           "Materials/tresca/Law=Mohr-Coulomb",
           "Materials/tresca/Density=600",
           exactly("Materials/tresca/Young's modulus", 250e3 * 1.3 / 1.49),
           "Materials/tresca/Poisson's ratio=0.3",
           "Materials/tresca/Pore water/Drainage=undrained",
           "Materials/tresca/Cohesion=2.5e3",
           "Materials/tresca/Friction angle=0",
           "Bodies/slide/Material=tresca"});
  expect_split_landslide(gates, tresca, 0.004);
  gates.at_most("front x [m], difference",
                relative_difference(tresca, total, "front x [m]", 30.),
                0.005);
}



// What compression and rest no longer need goes: the soil is as whole as
// without merging, the front the same.
TEST(LandslideMerged, ReturnsToThePointsOfTheStart)
{
  const std::string file = "landslide-quick.prm";
  Verification      gates("Landslide, h = 0.4 m, stretched splitting, merging",
                     "prm/" + file +
                       ", Splitting/Directions=stretched, "
                            "Splitting/Merge=true",
                     "the same without merging; points of the start");
  const Table       without = shared_run("slide-stretched");
  const Table       merged  = run<2>(file,
                              "landslide-merged",
                              stretched + Overrides{"Splitting/Merge=true"});
  expect_split_landslide(gates, merged, 0.002);
  gates.at_most("points at rest / at the start",
                merged["points"].back() / merged["points"].front(),
                2.);
  gates.at_most("front x [m], difference to 30 s",
                relative_difference(merged, without, "front x [m]", 30.),
                0.003);
  // Soil that was merged is not split again and again.
  gates.at_most("splits / splits without merging",
                merged["splits"].back() / without["splits"].back(),
                1.);
  EXPECT_GT(merged["merges"].back(), 1000);
  gates.at_most("merge conservation error",
                merged["merge conservation error [-]"].back(),
                1e-12);
  gates.at_most("merging work / gravity work",
                merged["merging work [J]"].back() /
                  merged["gravity work [J]"].back(),
                1e-3);
}



// Without splitting the slide tears: the program must say so.
TEST(LandslideUnsplit, FracturesAndStillBalances)
{
  Verification gates("Landslide, h = 0.4 m, unsplit",
                     "prm/landslide-quick.prm, Splitting/Enabled=false",
                     "balance of momentum and energy");
  const Table  table =
    run<2>("landslide-quick.prm", "landslide-unsplit", unsplit_slide);
  expect_momentum(gates, table);
  expect_energy(gates, table, 0.005, 0.005);
  EXPECT_EQ(table["splits"].back(), 0);
  expect_fracture(gates, table, 2);
  const double bodies = table["connected bodies"].back();
  gates.holds("unsplit: connected bodies at rest",
              text(bodies),
              "the toe has torn off: more than 1",
              bodies > 1);
}



namespace
{
  struct SlideState
  {
    unsigned long       n_steps = 0;
    std::vector<double> position;     // m
    double              distance = 0; // moved at most, m
  };



  /// Where the points are at time @p end, s, with splitting.
  SlideState
  run_to(const double end, const Overrides &overrides)
  {
    Case<2>    slide("landslide-quick.prm", stretched + overrides);
    SlideState state;
    while (slide->state().time < end)
      slide->advance();
    state.n_steps           = slide->state().step;
    const Points<2> &points = slide.points();
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double x = points.data(points.position, d)[p];
          state.position.push_back(x);
          state.distance =
            std::max(state.distance,
                     std::abs(x - points.data(points.initial_position, d)[p]));
        }
    return state;
  }



  void
  expect_same_path(Verification      &gates,
                   const SlideState  &a,
                   const SlideState  &b,
                   const std::string &name)
  {
    ASSERT_EQ(a.position.size(), b.position.size());
    double difference = 0;
    for (std::size_t i = 0; i < a.position.size(); ++i)
      {
        const double d = std::abs(a.position[i] - b.position[i]);
        difference     = (d <= difference ? difference : d);
      }
    EXPECT_GT(a.distance, 1.);
    gates.at_most("path at 2 s, difference / distance, " + name,
                  difference / a.distance,
                  1e-9);
  }
} // namespace



// Two changes of units that leave the path the same, with splitting.
TEST(LandslideSimilarity, PathIsTheSame)
{
  const double     s = 1. / 0.6, end = 2.;
  const SlideState reference = run_to(end, {exactly("End time", end)});
  const SlideState heavier =
    run_to(end * std::sqrt(s),
           {exactly("End time", end * std::sqrt(s)),
            exactly("Materials/clay/Density", 600. * s),
            exactly("Materials/clay/Submerged density", 600.)});
  const SlideState stronger =
    run_to(end / std::sqrt(s),
           {exactly("End time", end / std::sqrt(s)),
            exactly("Gravity/Magnitude", 9.81 * s),
            exactly("Materials/clay/Undrained shear strength", 2.5e3 * s),
            exactly("Materials/clay/Young's modulus", 250e3 * s),
            exactly("Boundaries/Seabed/Maximum shear stress", 1e3 * s)});
  Verification gates("Landslide, similarity",
                     "prm/landslide-quick.prm",
                     "the equations of motion");
  expect_same_path(gates, reference, heavier, "inertia x s");
  expect_same_path(gates, reference, stronger, "g, s_u, tau_max, E x s");
}
