// SPDX-License-Identifier: LGPL-2.1-or-later
// An elastic disc rolls down a face of the mesh and an obstacle,
// prm/verification/rolling-disc.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// Acceleration of a rolling disc over 2/3 g sin(angle).
  double
  relative_acceleration(const double angle, const Overrides &bed)
  {
    Table disc =
      run<2>("verification/rolling-disc.prm",
             "rolling-disc",
             bed + Overrides{"Gravity/Slope angle=" + std::to_string(angle)});
    std::vector<double> velocity = disc["momentum x [kg m/s]"];
    for (double &v : velocity)
      v /= disc["mass [kg]"][0];
    return slope(disc["time [s]"], velocity, 0.3, 1.5) /
           (2. / 3. * 10. * std::sin(angle * M_PI / 180.));
  }
} // namespace



TEST(RollingDisc, AcceleratesByTwoThirds)
{
  Verification    gates("Elastic disc rolls down an incline, h = R/20",
                     "prm/verification/rolling-disc.prm",
                     "2/3 g sin(angle)");
  const Overrides obstacle = {"Boundaries/Bottom=free",
                              "Obstacles/Names=bed",
                              "Obstacles/bed/Shape=box",
                              "Obstacles/bed/Lower corner=-10,-10",
                              "Obstacles/bed/Upper corner=20,0.0185",
                              "Obstacles/bed/Friction coefficient=0.3",
                              "Obstacles/bed/Maximum shear stress=1e9",
                              "Bodies/disc/Centre=1.5,1.0185"};
  const auto      check    = [&](const std::string &bed,
                         const Overrides   &settings,
                         const double       angle,
                         const double       ceiling) {
    const double      a = relative_acceleration(angle, settings);
    const std::string quantity =
      "acceleration on " + bed + text(" at ", angle, " degrees, ");
    if (ceiling > 0)
      gates.falls_short(
        quantity + "error over the closed form",
        std::abs(a - 1.),
        0.02,
        {ceiling, "not known; cells of R/40 leave two thirds of the error"});
    else
      gates.near(quantity + "over the closed form", a, 1., 0.02);
  };
  check("a face", {}, 10., 0.05);
  check("a face", {}, 20., 0.);
  check("a face", {}, 30., 0.03);
  check("an obstacle", obstacle, 10., 0.12);
  check("an obstacle", obstacle, 20., 0.06);
  check("an obstacle", obstacle, 30., 0.04);
}
