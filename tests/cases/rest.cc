// SPDX-License-Identifier: LGPL-2.1-or-later
// A stiff block that brakes on a level seabed, mu = 0.5, and so stops after
// v_0 / (mu g): the run ends when it is at rest.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

// A namespace of its own: several files are compiled as one.
namespace rest_test
{
  namespace
  {
    const std::string file = "verification/block-on-incline.prm";

    constexpr double initial_velocity = 4., // m/s
      mu = 0.5, duration = 0.5;             // [-], s of Rest/Duration

    const double time_of_stop = initial_velocity / (mu * 9.81); // s

    const Overrides overrides = {"Gravity/Slope angle=0",
                                 "Boundaries/Seabed/Friction coefficient=0.5",
                                 "Bodies/block/Initial velocity=4; 0",
                                 "Rest/Duration=0.5",
                                 "End time=3"};
  } // namespace



  TEST(Rest, EndsTheRun)
  {
    const Table  table = run<2>(file, "block-rest", overrides);
    Verification gates("Block that brakes on a level seabed",
                       "prm/" + file + ", Gravity/Slope angle=0",
                       "v_0 / (mu g)");
    gates.near("time of the end of the run [s]",
               table["time [s]"].back(),
               time_of_stop + duration,
               0.1);
    EXPECT_EQ(table["at rest"].back(), 1.);
  }



  TEST(Rest, DoesNotEndARunThatIsToGoOn)
  {
    const Table table = run<2>(file,
                               "block-rest-goes-on",
                               overrides + Overrides{"End when at rest=false"});
    EXPECT_EQ(table["time [s]"].back(), 3.);
    EXPECT_EQ(table.at(0.9 * time_of_stop, "at rest"), 0.);
    EXPECT_EQ(table["at rest"].back(), 1.);
  }



  // What moves by less than a cell is no slide, and may be set in motion later.
  TEST(Rest, NeedsASlide)
  {
    const Table table =
      run<2>(file,
             "block-rest-short",
             overrides + Overrides{"Bodies/block/Initial velocity=1; 0"});
    EXPECT_EQ(table["time [s]"].back(), 3.);
    EXPECT_EQ(table["at rest"].back(), 0.);
  }



  // Strength that falls in time may set soil in motion again.
  TEST(Rest, WaitsForTheTrigger)
  {
    const Table table =
      run<2>(file,
             "block-rest-trigger",
             overrides + Overrides{"Trigger/Seabed shear stress fraction=0.9",
                                   "Trigger/Start time=1.5",
                                   "Trigger/Duration=0.5"});
    EXPECT_GE(table["time [s]"].back(), 2. + duration);
  }
} // namespace rest_test
