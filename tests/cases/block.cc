// SPDX-License-Identifier: LGPL-2.1-or-later
// A stiff block on a plane of 30 degrees,
// prm/verification/block-on-incline.prm.

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



// At rest under its own weight: with gravity switched on at once the block
// rings and, as any elastic body on Coulomb friction, slips whenever its base
// is unloaded.
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



// The force that the seabed feels is the one that brakes the block, and what it
// bears is the block's weight.
TEST(Block, ForceOnTheSeabed)
{
  const Table statistics =
    run<2>(file, "block-force", {"Boundaries/Write forces=true"});
  const Table forces(std::filesystem::path(TALUS_RESULTS_DIR) / "block-force" /
                     "boundaries.csv");
  for (unsigned int row = 0; row < forces.n_rows(); ++row)
    EXPECT_NEAR(forces["Bottom impulse x [N s]"][row],
                -statistics["seabed impulse x [N s]"][row],
                1e-9);
  double weight = 0, friction = 0;
  int    n = 0;
  for (unsigned int row = 0; row < forces.n_rows(); ++row)
    if (forces["time [s]"][row] > 0.3)
      {
        weight -= forces["Bottom force y [N]"][row];
        friction += forces["Bottom friction force x [N]"][row];
        ++n;
      }
  Verification gates("Block on 30 degrees, mu = 0.3",
                     "prm/" + file + " with Boundaries/Write forces",
                     "weight");
  gates.near("normal force on the seabed [N]",
             weight / n,
             4000 * gravity_across,
             0.005);
  // Friction follows the mean normal force of 32 steps, which rings.
  gates.near("friction over normal force", friction / weight, 0.3, 0.005);
}



// Without the gap, soil is caught when the nodes of the face begin to carry it,
// up to a cell early.
TEST(Block, FallsOntoASeabedWithGap)
{
  for (const std::string gap : {"false", "true"})
    {
      const Table table = run<2>(file,
                                 "block-falls-on-seabed",
                                 {"Boundaries/Seabed/Gap=" + gap,
                                  "Boundaries/Write forces=true",
                                  "Gravity/Slope angle=0",
                                  "Bodies/block/Lower corner=0, 0.75",
                                  "Bodies/block/Upper corner=2, 1.75",
                                  "Output/Statistics interval=0.002",
                                  "End time=0.6"});
      const Table forces(std::filesystem::path(TALUS_RESULTS_DIR) /
                         "block-falls-on-seabed" / "boundaries.csv");
      std::size_t i = 0;
      while (i + 1 < forces.n_rows() &&
             forces["Bottom contact area [m]"][i] == 0)
        ++i;
      const double time   = forces["time [s]"][i];
      const double fallen = 0.5 * 9.81 * time * time;
      if (gap == "false")
        {
          EXPECT_LT(fallen, 0.56) << "the gap changes nothing";
          continue;
        }
      Verification gates("Block falls 0.75 m onto a seabed with a gap",
                         "prm/" + file + " with Boundaries/Seabed/Gap",
                         "free fall; energy");
      gates.holds("height of fall at the first contact [m]",
                  std::to_string(fallen),
                  "0.70 to 0.76",
                  fallen > 0.7 && fallen < 0.76);
      double gain = 0;
      for (unsigned int row = 0; row < table.n_rows(); ++row)
        gain = std::max(gain,
                        table["kinetic energy [J]"][row] +
                          table["elastic energy [J]"][row] -
                          table["gravity work [J]"][row]);
      gates.at_most("energy gained, over that of the fall",
                    gain / (0.75 * 9.81 * 4000),
                    0.001);
    }
}
