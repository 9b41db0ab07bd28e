// SPDX-License-Identifier: LGPL-2.1-or-later
// A Bingham fluid runs out on a base that holds it and comes to rest,
// validation/gypsum-tailings.prm. Its soil is sheared by the thousand: with a
// deformation gradient that only grows, det F of a point is round-off after
// 55 s (h = 1 m) and the run ends. And syrup behind a gate that is lifted,
// prm/verification/gate.prm.

#include "case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus::cases;

namespace
{
  /// Length of the deposit whose weight the yield stress of 1 kPa just holds,
  /// m. Balance h dh/dx = tau_y / (rho g) gives a parabola; its area is that of
  /// the dam, 11 m x 110 m. Inertia carries the soil farther, so it cannot be
  /// shorter.
  double
  length_in_balance()
  {
    const double slope = 2. * 1000. / (1400. * 9.81);
    return std::pow(1.5 * 11. * 110. / std::sqrt(slope), 2. / 3.);
  }



  void
  expect_rest(const std::string &cell_size)
  {
    const Table table =
      run<2>("validation/gypsum-tailings.prm",
             "gypsum-dam-" + cell_size,
             {"Grid/Cell size=" + cell_size, "End when at rest=false"});
    const auto  &energy  = table["grid kinetic energy [J]"];
    const double largest = *std::max_element(energy.begin(), energy.end());
    EXPECT_GE(table["time [s]"].back(), 150.);
    EXPECT_LT(energy.back(), 1e-4 * largest);
    EXPECT_LT(std::abs(table["centre velocity x [m/s]"].back()), 1e-3);
    EXPECT_EQ(table["connected bodies"].back(), 1.);
    EXPECT_GT(table["front of 99.5 % mass x [m]"].back() + 110.,
              length_in_balance());
  }
} // namespace



TEST(GypsumDam, ComesToRest)
{
  expect_rest("2");
}



TEST(GypsumDamFine, ComesToRest)
{
  expect_rest("1");
}



// Rows are 0.05 s apart. The gate rests for 4 rows and clears the syrup in 3
// more; the lag is neither nothing nor more than twice that time.
TEST(Gate, FrontLagsBehindADamGoneAtOnce)
{
  const Table lifted      = run<2>("verification/gate.prm", "gate"),
              sudden      = run<2>("verification/gate.prm",
                              "no-gate",
                              {"Obstacles/gate/Lower corner=0.37, 0",
                                    "Obstacles/gate/Upper corner=0.39, 0.1"});
  const std::string front = "front of 99.5 % mass x [m]";
  for (const double mass : lifted["mass [kg]"])
    EXPECT_NEAR(mass, lifted["mass [kg]"].front(), 1e-12);
  ASSERT_EQ(lifted.n_rows(), 25u);
  for (unsigned int row = 6; row + 4 < lifted.n_rows(); ++row)
    {
      EXPECT_LT(lifted[front][row + 4], sudden[front][row] - 0.002);
      EXPECT_GT(lifted[front][row + 4], sudden[front][row - 6]);
    }
}
