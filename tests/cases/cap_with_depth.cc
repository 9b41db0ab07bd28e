// SPDX-License-Identifier: LGPL-2.1-or-later
// A largest shear stress of the seabed, or of an obstacle, that grows with the
// depth below the mudline of the start.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// 2 m long, 1 m high at the rear and @p front m at the front.
  std::string
  wedge(const double front)
  {
    return text("Bodies/block/Vertices=0,0; 2,0; 2,", front, "; 0,1");
  }



  /// With the stress k depth(x), depth = 1 - (1 - front) x/2, which stays where
  /// it was, the friction on a wedge that has moved by s < 2 m is that on the
  /// part that is still below it, k int_s^2 depth dx. Beyond there is none.
  void
  expect_work(const Table &table,
              const double k,
              const double front,
              const double gravity)
  {
    const double mass    = 2000. * (1. + front);
    const auto  &x       = table["centre x [m]"];
    const auto  &v       = table["centre velocity x [m/s]"];
    const auto  &work    = table["friction work [J]"];
    const auto   exactly = [&](const double s) {
      return k * (2. * s - s * s / 2. - (1. - front) * (s - s * s * s / 12.));
    };
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        const double moved = x[i] - x[0];
        const double exact = exactly(std::min(moved, 2.));
        EXPECT_NEAR(work[i], exact, 0.01 * k) << "after " << moved << " m";
        EXPECT_NEAR(0.5 * v[i] * v[i], gravity * moved - exact / mass, 0.02)
          << "after " << moved << " m";
      }
    EXPECT_GT(x.back() - x[0], 2.5);
    EXPECT_NEAR(work.back(), exactly(2.), 0.005 * exactly(2.));
  }
} // namespace



// At the node, a step of the stress would be felt up to a cell beyond: so the
// wedge ends with a toe.
TEST(CapWithDepth, WedgeOnASeabed)
{
  const Table table =
    run<2>("verification/block-on-incline.prm",
           "cap-with-depth-seabed",
           {"End time=1.2",
            "Grid/Cell size=0.125",
            "Bodies/block/Shape=polygon",
            wedge(0.),
            "Boundaries/Seabed/Friction coefficient=10",
            "Boundaries/Seabed/Maximum shear stress=3000*depth"});
  expect_work(table, 3000., 0., 9.81 * std::sin(M_PI / 6.));
}



TEST(CapWithDepth, WedgeOnAnObstacle)
{
  const Table table =
    run<2>("verification/block-on-plane.prm",
           "cap-with-depth-obstacle",
           {"Gravity/Slope angle=20",
            wedge(0.5),
            "Obstacles/plane/Normal=0, 1",
            "Obstacles/plane/Friction coefficient=10",
            "Obstacles/plane/Maximum shear stress=3000*depth"});
  expect_work(table, 3000., 0.5, 9.81 * std::sin(M_PI / 9.));
}



// The cap is the strength: k H/(gamma H sin), whatever the cells.
TEST(CapWithDepth, FactorOfSafetyOnASeabed)
{
  const StaticCase<2> slope(
    "verification/infinite-slope.prm",
    "cap-with-depth-static",
    {"Boundaries/Bottom=seabed",
     "Boundaries/Seabed/Friction coefficient=100",
     "Boundaries/Seabed/Maximum shear stress=4000*depth",
     "Strength reduction/Seabed=true",
     "Materials/clay/Undrained shear strength=1e6"});
  EXPECT_NEAR(slope.factor_of_safety(),
              4000. / (1e4 * std::sin(M_PI / 9.)),
              2e-3);
}



// A bed of two strengths, a surface by name, at every other node: the mean
// counts.
TEST(CapWithDepth, FactorOfSafetyOfABedOfTwoStrengths)
{
  const StaticCase<2> slope(
    "verification/infinite-slope.prm",
    "cap-of-two-strengths",
    {"Surfaces/Names=ratio",
     "Surfaces/ratio/Expression=if(abs(x - 0.05) < 0.02, 1.5, 0.5)",
     "Boundaries/Bottom=seabed",
     "Boundaries/Seabed/Friction coefficient=100",
     "Boundaries/Seabed/Maximum shear stress=4000*depth*ratio",
     "Strength reduction/Seabed=true",
     "Materials/clay/Undrained shear strength=1e6"});
  EXPECT_NEAR(slope.factor_of_safety(),
              4000. / (1e4 * std::sin(M_PI / 9.)),
              2e-3);
}



TEST(CapWithDepth, WhatCannotBeIsSaid)
{
  const auto error = [](const Overrides &overrides) {
    try
      {
        const Case<2> run("verification/block-on-plane.prm", overrides);
      }
    catch (const ExcUser &error)
      {
        dealii::ParameterAcceptor::clear();
        dealii::ParameterAcceptor::prm.clear();
        std::ostringstream reason;
        error.print_info(reason);
        return reason.str();
      }
    return std::string();
  };
  const std::string cap = "Obstacles/plane/Maximum shear stress=";
  EXPECT_NE(error({cap + "1e3*depth", "Obstacles/plane/Velocity=1; 0"})
              .find("but the obstacle moves"),
            std::string::npos);
  EXPECT_NE(error({cap + "1e3*depht"}).find("in x, y, depth, pi"),
            std::string::npos);
  EXPECT_NE(error({cap + "1e3*ratos",
                   "Surfaces/Names=ratio",
                   "Surfaces/ratio/Expression=1"})
              .find("in x, y, depth, ratio, pi"),
            std::string::npos);
  EXPECT_NE(error({cap + "1e3*(depth - 0.5)"}).find("cannot be negative"),
            std::string::npos);
  EXPECT_NE(error({cap + "-5"}).find("is -5 Pa, but a shear stress"),
            std::string::npos);
}
