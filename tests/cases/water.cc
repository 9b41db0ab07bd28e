// SPDX-License-Identifier: LGPL-2.1-or-later
// A stiff block that slides under water, prm/verification/block-in-water.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string water_file = "verification/block-in-water.prm";

  // (rho + C_m rho_w) du/dt = A - B u^2, for each volume of the block.
  const double driving        = 600. * 9.81 * std::sin(M_PI / 36.) - 1000. / 5.;
  const double drag           = 0.5 * 1000. * (0.01 / 5. + 1. / 40.);
  const double final_velocity = std::sqrt(driving / drag); // m/s
  const double time_scale =
    (1600. + 0.1 * 1000.) / std::sqrt(driving * drag); // s

  double
  displacement(const double t)
  {
    return final_velocity * time_scale * std::log(std::cosh(t / time_scale));
  }

  /// Mean force of the water against the motion over the last interval, and
  /// that which the velocities then give for a block with sharp edges, N.
  std::pair<double, double>
  drag_at_end(const Table &table)
  {
    const unsigned int n = table.n_rows() - 1;
    const auto        &t = table["time [s]"];
    const auto        &J = table["drag impulse x [N s]"];
    const auto        &u = table["centre velocity x [m/s]"];
    const double       u2 =
      (u[n] * u[n] + u[n] * u[n - 1] + u[n - 1] * u[n - 1]) / 3.;
    return {-(J[n] - J[n - 1]) / (t[n] - t[n - 1]),
            0.5 * 1000. * (0.01 * 40. + 1. * 5.) * u2};
  }
} // namespace



TEST(BlockInWater, VelocityAndDisplacement)
{
  const Table  table = run<2>(water_file, "block-in-water");
  Verification rows("Block in water, 5 degrees",
                    "prm/" + water_file,
                    "u_t tanh(t/t_0)");
  rows.near("velocity at 10 s [m/s]",
            table.at(10., "centre velocity x [m/s]"),
            final_velocity * std::tanh(10. / time_scale),
            0.01);
  rows.near("displacement in 10 s [m]",
            table.at(10., "centre x [m]") - table.at(0., "centre x [m]"),
            displacement(10.),
            0.01);
}



// The momentum of soil and water together changes by the impulses on them, and
// the energies add up.
TEST(BlockInWater, BudgetsClose)
{
  const Table        table = run<2>(water_file, "block-in-water-budgets");
  const unsigned int n     = table.n_rows() - 1;
  const double       gravity =
    600. * 200. * 9.81 * std::sin(M_PI / 36.) * table["time [s]"][n];
  const double momentum = table["momentum x [kg m/s]"][n] +
                          table["added mass momentum x [kg m/s]"][n];
  EXPECT_NEAR(table["added mass momentum x [kg m/s]"][n],
              0.1 * 1000. / 1600. * table["momentum x [kg m/s]"][n],
              1e-9 * momentum);
  EXPECT_NEAR(momentum,
              gravity + table["seabed impulse x [N s]"][n] +
                table["drag impulse x [N s]"][n],
              1e-6 * momentum);
  EXPECT_LT(std::abs(table["energy remainder [J]"][n]),
            1e-3 * table["drag work [J]"][n]);
}



// The contour cuts the edges off, by a length of the order of a cell: the drag
// of the nose misses by half of it when the cells are halved.
TEST(BlockInWater, DragConverges)
{
  std::array<double, 3> missing;
  Verification          rows("Block in water, drag by cell size",
                    "prm/" + water_file,
                    "1/2 rho_w (C_F L + C_P H) u^2, first order in h");
  for (unsigned int i = 0; i < 3; ++i)
    {
      const std::string h       = i == 0 ? "1" : i == 1 ? "0.5" : "0.25";
      const auto [force, exact] = drag_at_end(
        run<2>(water_file, "block-in-water-" + h, {"Grid/Cell size=" + h}));
      missing[i] = 1. - force / exact;
      rows.at_most("drag missing at h = " + h + " m [-]",
                   missing[i],
                   0.08 / std::pow(2., i));
    }
  EXPECT_GT(missing[2], 0.);
  EXPECT_NEAR(missing[0] / missing[1], 2., 0.2);
  EXPECT_NEAR(missing[1] / missing[2], 2., 0.2);
}



// A sheet of 2 cm on cells of a metre, thrown up at 20 m/s: the drag takes what
// the sheet has in every interval, and the bed gives nothing.
TEST(SheetInWater, DragOnlyBrakes)
{
  const Table  table  = run<2>("sheet-in-water.prm", "sheet-in-water");
  const auto  &drag   = table["drag work [J]"];
  const auto  &bed    = table["contact work [J]"];
  const double energy = table["kinetic energy [J]"][0];
  double       gained = 0, given = 0;
  for (unsigned int i = 1; i < table.n_rows(); ++i)
    {
      gained = std::max(gained, drag[i - 1] - drag[i]);
      given  = std::max(given, -bed[i]);
    }
  Verification rows("Thin sheet thrown into water",
                    "tests/cases/sheet-in-water.prm",
                    "drag brakes only");
  rows.at_most("energy gained by drag in an interval / energy at the start",
               gained / energy,
               0.);
  rows.at_most("energy lost by drag / energy at the start",
               drag.back() / energy,
               1.);
  rows.at_most("energy given by the bed / energy at the start",
               given / energy,
               0.);
}
