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
  /// 2 m long, 1 m high at the rear and 0.5 m at the front.
  const std::string wedge = "Bodies/block/Vertices=0,0; 2,0; 2,0.5; 0,1";



  /// With the stress k depth(x) that stays where it was the friction on the
  /// wedge, moved by s < 2 m, is that on the part that is still below it,
  ///   k int_s^2 (1 - x/4) dx = k (3/2 - s + s^2/8),
  /// and its work until the wedge has left that place is 4/3 k; beyond there is
  /// none.
  void
  expect_work(const Table &table, const double k, const double gravity)
  {
    const auto &x    = table["centre x [m]"];
    const auto &v    = table["centre velocity x [m/s]"];
    const auto &work = table["friction work [J]"];
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        const double s     = std::min(x[i] - x[0], 2.);
        const double exact = k * (1.5 * s - s * s / 2. + s * s * s / 24.);
        EXPECT_NEAR(work[i], exact, 0.02 * k) << "s = " << s;
        // The mass is 3000 kg.
        EXPECT_NEAR(0.5 * v[i] * v[i],
                    gravity * (x[i] - x[0]) - exact / 3000.,
                    0.02 * k / 3000. + 0.02)
          << "s = " << s;
      }
    EXPECT_GT(x.back() - x[0], 2.2);
    EXPECT_NEAR(work.back(), 4. / 3. * k, 0.01 * k);
  }
} // namespace



TEST(CapWithDepth, WedgeOnASeabed)
{
  const Table table =
    run<2>("verification/block-on-incline.prm",
           "cap-with-depth-seabed",
           {"End time=1.5",
            "Bodies/block/Shape=polygon",
            wedge,
            "Boundaries/Seabed/Friction coefficient=10",
            "Boundaries/Seabed/Maximum shear stress=3000*depth"});
  expect_work(table, 3000., 9.81 * std::sin(M_PI / 6.));
}



TEST(CapWithDepth, WedgeOnAnObstacle)
{
  const Table table =
    run<2>("verification/block-on-plane.prm",
           "cap-with-depth-obstacle",
           {"Gravity/Slope angle=20",
            wedge,
            "Obstacles/plane/Normal=0, 1",
            "Obstacles/plane/Friction coefficient=10",
            "Obstacles/plane/Maximum shear stress=3000*depth"});
  expect_work(table, 3000., 9.81 * std::sin(M_PI / 9.));
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
  EXPECT_NE(error({cap + "1e3*(depth - 0.5)"}).find("cannot be negative"),
            std::string::npos);
  EXPECT_NE(error({cap + "-5"}).find("is -5 Pa, but a shear stress"),
            std::string::npos);
}
