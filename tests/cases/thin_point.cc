// SPDX-License-Identifier: LGPL-2.1-or-later
// A single thin point falls through the air, thin-point.prm. At the time step
// of the bulk its stress grows from step to step: without a bound on the strain
// of a step the point is turned inside out, or is thrown through the mesh.

#include "case.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace talus::cases;

TEST(ThinPoint, Falls)
{
  const Table  table    = run<2>("thin-point.prm", "thin-point", {});
  const double time     = table["time [s]"].back();
  const double velocity = table["centre velocity y [m/s]"].back();
  EXPECT_GE(time, 1.5);
  // Velocities belong to the middle of a step of 4 ms.
  EXPECT_NEAR(velocity, -9.81 * time, 0.04);
  EXPECT_LT(table["maximum speed of points [m/s]"].back(), 9.81 * time + 0.04);
  EXPECT_EQ(table["points"].back(), 1.);
}
