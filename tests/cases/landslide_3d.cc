// SPDX-License-Identifier: LGPL-2.1-or-later
// A short landslide in 3-D, three cells wide between rollers: plane strain, so
// that it must follow the 2-D one.

#include "landslide.h"

#include <gtest/gtest.h>

using namespace talus;
using namespace talus::cases;

TEST(Landslide3d, FollowsThe2dFront)
{
  const Table  thick = run<3>("landslide-3d.prm", "landslide-3d");
  const Table  plane = run<2>("landslide-quick.prm",
                             "landslide-2d",
                             {"Grid/Cell size=0.8",
                               "End time=4",
                               "Splitting/Directions=stretched",
                               "Splitting/Shear=ignored",
                               "Splitting/Merge=true"});
  Verification gates("3-D slide between rollers, h = 0.8 m",
                     "prm/landslide-3d.prm",
                     "the 2-D slide");
  EXPECT_GT(plane["front x [m]"].back() - plane["front x [m]"][0], 3.);
  for (const std::string column : {"front x [m]", "centre x [m]", "height [m]"})
    gates.at_most("3-D against 2-D, to 4 s: " + column,
                  relative_difference(thick, plane, column, 4.),
                  0.01);
  expect_momentum(gates, thick);
  EXPECT_NEAR(thick["mass [kg]"][0], 2.4 * plane["mass [kg]"][0], 1e-6);
  EXPECT_GT(thick["splits"].back(), 0);
  expect_continuum(gates, thick);
}
