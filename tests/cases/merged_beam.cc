// SPDX-License-Identifier: LGPL-2.1-or-later
// A beam of rubber, prm/verification/cantilever.prm, whose points are merged
// once while it bends.

#include "case.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus::cases;

namespace
{
  void
  expect_energy_booked(const std::string &rule)
  {
    const auto   table = run<2>("verification/cantilever.prm",
                              "merged-beam",
                              {"Splitting/Merge=all",
                                 "Splitting/Merge interval=400",
                                 "Bodies/beam/Points per cell and axis=5",
                                 "Transfer/Box rule=" + rule,
                                 "Output/Statistics interval=0.02",
                                 "End time=0.6"});
    const double work  = table["gravity work [J]"].back();
    EXPECT_LT(table["points"].back(), 0.75 * table["points"].front());
    // What the means of deformation gradients no longer store ...
    EXPECT_GT(table["merging work [J]"].back(), 1.5e-3 * work);
    // ... is not missing.
    EXPECT_LT(std::abs(table["energy remainder [J]"].back()), 5e-4 * work);
  }
} // namespace



// The oracle is the conservation of energy. Hyperelastic laws compute stress
// and energy from F, so the energy of two points is not that of their mean.
TEST(MergedBeam, ElasticEnergyThatGoesIsBooked)
{
  expect_energy_booked("axis-parallel");
  expect_energy_booked("convected domain");
}
