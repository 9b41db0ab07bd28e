// SPDX-License-Identifier: LGPL-2.1-or-later
// Modified Cam clay in whole runs: strength and swelling by closed forms.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double pi_over_180 = M_PI / 180.;

  /// Factor of safety of an infinite slope of normally consolidated, undrained
  /// clay with K0 = 1 - sin(phi): t = sin(phi_F) p_cs, tan(phi_F) = tan(phi)/F,
  /// with the mean stress p_cs of the critical state at the volume of the soil,
  /// p_cs = p (p_c/(2 p))^Lambda. The preconsolidation pressure is that of the
  /// stress in the slope, which is on the yield surface. Stresses over that
  /// across the layer.
  double
  factor_of_safety(const double slope, const double phi, const double Lambda)
  {
    const double sine = std::sin(phi * pi_over_180), K0 = 1. - sine;
    const double t = std::tan(slope * pi_over_180);
    const double p = (1. + 2. * K0) / 3.;
    // Principal stresses, compression positive; the third is K0.
    const double radius   = std::hypot(0.5 * (1. - K0), t);
    const double largest  = 0.5 * (1. + K0) + radius;
    const double smallest = std::min(0.5 * (1. + K0) - radius, K0);
    // q/M of Mohr-Coulomb's criterion.
    const double shear =
      0.5 * (largest - smallest) / sine - 0.5 * (largest + smallest) + p;
    const double p_c  = p + shear * shear / p;
    const double p_cs = p * std::pow(p_c / (2. * p), Lambda);
    return std::tan(phi * pi_over_180) / std::tan(std::asin(t / p_cs));
  }



  /// Clay in place of the material @p other of @p body.
  Overrides
  clay(const std::string &other, const std::string &body, const Overrides &more)
  {
    return Overrides{"Materials/Names=" + other + ", clay",
                     "Bodies/" + body + "/Material=clay",
                     "Materials/clay/Law=modified Cam clay",
                     "Materials/clay/Attraction=0.1"} +
           more;
  }
} // namespace



TEST(CamClay, FactorOfSafety)
{
  Verification gates("Infinite slope of normally consolidated clay",
                     "prm/verification/infinite-slope-friction.prm, undrained",
                     "critical state at the volume of the soil");
  for (const auto &[slope, phi] : {std::pair{5., 25.}, {8., 30.}})
    gates.near(
      text("factor of safety, slope of ", slope, " degrees"),
      StaticCase<2>(
        "verification/infinite-slope-friction.prm",
        text("clay-slope-", slope),
        clay("sand",
             "layer",
             {text("Gravity/Slope angle=", slope),
              text("Materials/clay/Friction angle=", phi),
              "Materials/clay/Pore water/Drainage=undrained",
              "Materials/clay/Pore water/Undrained Poisson's ratio=0.4999",
              text("Bodies/layer/K0=",
                   std::setprecision(15),
                   1. - std::sin(phi * pi_over_180)),
              "Strength reduction/Tolerance=1e-4"}))
        .factor_of_safety(),
      factor_of_safety(slope, phi, 0.8),
      0.002);
}



// The pressure rises to half of the weight, and overconsolidated clay between
// smooth walls swells by kappa/(1 + e_0) ln(p_0/p), p with the attraction. Of
// the pressure p_0 - p is (1 + nu)/(3 (1 - nu)).
TEST(CamClay, ColumnSwells)
{
  const Table table =
    run<2>("pore-column.prm",
           "clay-swells",
           clay("soil",
                "column",
                {"Materials/clay/Density=2000",
                 "Materials/clay/Attraction=2e3",
                 "Materials/clay/Poisson's ratio=0.25",
                 "Materials/clay/Overconsolidation ratio=8"}));
  constexpr unsigned int n    = 100000;
  const double           H    = 5.;
  double                 rise = 0.; // of the centre of mass
  for (unsigned int i = 0; i < n; ++i)
    {
      const double weight = 20e3 * (i + 0.5) * H / n; // at a depth
      const double before = 2. / 3. * weight + 2e3;
      const double after  = before - 0.5 * weight * 1.25 / (3. * 0.75);
      // All soil above rises.
      rise +=
        std::expm1(0.02 * std::log(before / after)) * (i + 0.5) / n * H / n;
    }
  const auto  &y = table["centre y [m]"];
  Verification gates("Column of clay with rising excess pore pressure",
                     "tests/cases/pore-column.prm, modified Cam clay",
                     "swelling line");
  gates.near("rise of the centre of mass [m]",
             y.back() - y.front(),
             rise,
             0.005);
  gates.at_most("plastic work [J]",
                std::abs(table["plastic work [J]"].back()),
                1e-9);
}
