// SPDX-License-Identifier: LGPL-2.1-or-later
// A stiff block on a plane of 30 degrees, prm/verification/block-on-incline.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string file = "verification/block-on-incline.prm";

  const double gravity_along  = 9.81 * std::sin(M_PI / 6.); // m/s^2
  const double gravity_across = 9.81 * std::cos(M_PI / 6.); // m/s^2

  /// Acceleration of the centre of mass after the elastic onset, m/s^2.
  double
  acceleration(const Table &table)
  {
    return slope(table["time [s]"], table["centre velocity x [m/s]"], 0.3, 1.);
  }



  /// The centre stays at x = 1 m and creeps by less than 1 mm/s.
  void
  expect_stuck(const Table &table, const std::string &name)
  {
    const double creep =
      (table.at(1., "centre x [m]") - table.at(0.3, "centre x [m]")) / 0.7;
    Verification("Block on 30 degrees, mu = 0.7",
                 "prm/" + file + ", in equilibrium at the start",
                 "sticks below the angle of friction")
      .at_most("creep [m/s], " + name, std::abs(creep), 1e-3);
    EXPECT_LT(std::abs(table.at(1., "centre x [m]") - 1.), 1e-3);
  }
} // namespace



TEST(Block, CoulombFriction)
{
  const Table  table = run<2>(file, "block-coulomb");
  const double exact = gravity_along - 0.3 * gravity_across;
  Verification("Block on 30 degrees, mu = 0.3",
               "prm/" + file,
               "g (sin - mu cos)")
    .near("acceleration [m/s^2]", acceleration(table), exact, 0.002);
}



// At rest under its own weight: with gravity switched on at once the block rings
// and, as any elastic body on Coulomb friction, slips whenever its base is
// unloaded.
TEST(Block, SticksBelowTheAngleOfFriction)
{
  const std::string weight = "2000*9.81*(1-y)";
  const Table       table =
    run<2>(file,
           "block-sticks",
           {"Boundaries/Seabed/Friction coefficient=0.7",
            "Bodies/block/Initial stress=0; -" + weight + "*cos(pi/6); -0.3*" +
              weight + "*cos(pi/6); " + weight + "*sin(pi/6)"});
  expect_stuck(table, "2-D");
}



// What a roller holds must not use up the friction of the nodes on both faces.
TEST(Block, SticksBetweenRollersIn3d)
{
  expect_stuck(run<3>("verification/block-between-rollers.prm",
                      "block-between-rollers"),
               "3-D between rollers");
}



// Where the cap governs, its stress times the contact area brakes, whatever the
// normal force: a = g sin - tau_max/(rho H).
TEST(Block, CappedInterface)
{
  const Table  table = run<2>(file,
                             "block-capped",
                             {"Boundaries/Seabed/Friction coefficient=10",
                               "Boundaries/Seabed/Maximum shear stress=3000"});
  const double exact = gravity_along - 3000. / (2000. * 1.);
  Verification("Block on 30 degrees, tau_max = 3 kPa",
               "prm/" + file,
               "g sin - tau_max/(rho H)")
    .near("acceleration [m/s^2]", acceleration(table), exact, 0.02);
}
