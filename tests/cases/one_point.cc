// SPDX-License-Identifier: LGPL-2.1-or-later
// One point of soil, driven by velocities on the faces of a mesh of one cell,
// as in a test in the laboratory.

#include "case.h"
#include "driven.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

using namespace talus;
using namespace talus::cases;

TEST(OnePoint, SimpleShear)
{
  constexpr double G = 250e3 / 2.98, s_u = 2.5e3, gdot = 0.01;
  Case<2>          shear("verification/simple-shear.prm", {});
  const double     gamma_yield   = 2. * std::asin(0.5 * s_u / G);
  double           elastic_error = 0, plateau_error = 0, yielded_at = 0;
  while (shear->state().time < 10. - 1e-12)
    {
      shear->advance();
      const double   gamma = gdot * shear->state().time;
      const StressOf s(shear.points(), 0);
      if (gamma < gamma_yield - 1e-5)
        elastic_error = std::max(elastic_error,
                                 s.distance(G * (1. - std::cos(gamma)),
                                            -G * (1. - std::cos(gamma)),
                                            0.,
                                            G * std::sin(gamma)) /
                                   s_u);
      else if (gamma > gamma_yield + 1e-5)
        plateau_error =
          std::max(plateau_error, std::abs(std::hypot(s.xy, s.xx) - s_u) / s_u);
      if (yielded_at == 0 &&
          shear.points().data(shear.points().plastic_work)[0] > 0)
        yielded_at = gamma;
    }
  // The steady state lies within exp(-(gamma - gamma_yield) G/s_u).
  const StressOf last(shear.points(), 0);
  const double   steady = s_u * std::sqrt(1. - std::pow(s_u / G, 2));
  Verification   gates("Simple shear, von Mises",
                     "prm/verification/simple-shear.prm",
                     "tau = G sin(gamma) (Jaumann rate), then sqrt(tau^2 + "
                       "s_xx^2) = s_u");
  gates.at_most("error before yield / s_u", elastic_error, 1e-10);
  gates.at_most("error of the yield stress / s_u", plateau_error, 1e-10);
  gates.near("shear at first yield", yielded_at, gamma_yield, 3.4e-4);
  gates.near("shear stress at the end [Pa]", last.xy, steady, 1e-4);
  for_points(shear, [&](const unsigned int p) {
    EXPECT_LT(
      StressOf(shear.points(), p).distance(last.xx, last.yy, last.zz, last.xy),
      1e-8 * s_u);
  });
}



TEST(OnePoint, PlaneStrainCompression)
{
  Case<2>      sample("verification/plane-strain-compression.prm", {});
  const double first_yield = 2500. * std::sqrt(3. / (1. - 0.49 + 0.49 * 0.49));
  double       before = 0, at = 0, elastic_error = 0;
  while (sample->state().time < 200. - 1e-12)
    {
      sample->advance();
      const double t  = sample->state().time;
      const double yy = -StressOf(sample.points(), 0).yy;
      const bool   has_yielded =
        sample.points().data(sample.points().plastic_work)[0] > 0;
      if (at == 0 && has_yielded)
        at = yy;
      if (!has_yielded)
        {
          before = yy;
          if (t < 20.) // until the start has died away
            continue;
          const double exact = 250e3 / (1. - 0.49 * 0.49) * 2e-4 * t;
          elastic_error = std::max(elastic_error, std::abs(yy - exact) / 5e3);
        }
    }
  const StressOf last(sample.points(), 0);
  Verification   gates("Plane-strain compression, von Mises",
                     "prm/verification/plane-strain-compression.prm",
                     "sqrt(3) s_u/sqrt(1 - nu + nu^2), then 2 s_u");
  gates.at_most("elastic stress, error / 2 s_u", elastic_error, 1e-5);
  EXPECT_LT(before, first_yield + 0.01);
  gates.near("first yield [Pa]", at, first_yield, 1e-4);
  gates.near("plateau [Pa]", -last.yy, 5000., 1e-5);
  gates.near("plateau, stress out of plane [Pa]", -last.zz, 2500., 4e-3);
}



// No stress on the sides: s_1 = 2 c tan(45 degrees + phi/2).
TEST(OnePoint, FrictionInPlaneStrainCompression)
{
  Case<2> sample("verification/plane-strain-compression.prm",
                 {"Materials/Names=clay, sand",
                  "Materials/sand/Law=Mohr-Coulomb",
                  "Materials/sand/Density=600",
                  "Materials/sand/Young's modulus=250e3",
                  "Materials/sand/Poisson's ratio=0.49",
                  "Materials/sand/Cohesion=1000",
                  "Bodies/sample/Material=sand"});
  while (sample->state().time < 200. - 1e-12)
    sample->advance();
  Verification gates("Plane-strain compression, Mohr-Coulomb",
                     "prm/verification/plane-strain-compression.prm",
                     "2 c sqrt(K_p)");
  gates.near("plateau [Pa]",
             -StressOf(sample.points(), 0).yy,
             2000. * std::sqrt(3.),
             1e-5);
}



// At constant volume the dilation that fades, in all D = int of beta d(xi),
// changes the mean effective stress by K D: s_u = (p'_0 + K D) sin(phi). Soil
// that contracts by more than p'_0/K liquefies.
TEST(OnePoint, UndrainedDilationThatFades)
{
  Verification gates("Simple shear of undrained sand, phi' = 30 degrees",
                     "prm/verification/simple-shear.prm, psi that fades",
                     "p'_0 + K int(beta d xi)");
  for (const auto &[psi, fading, exact] :
       {std::tuple{5., 0.02, 64533.6}, {-5., 0.02, 35466.4}, {-10., 0.05, 0.}})
    {
      Case<2> sample("verification/simple-shear.prm",
                     {"End time=30",
                      "Materials/Names=clay, sand",
                      "Materials/sand/Law=Mohr-Coulomb",
                      "Materials/sand/Density=600",
                      "Materials/sand/Young's modulus=20e6",
                      "Materials/sand/Poisson's ratio=0.3",
                      text("Materials/sand/Dilatancy angle=", psi),
                      text("Materials/sand/Dilation strain=", fading),
                      "Materials/sand/Pore water/Drainage=undrained",
                      "Bodies/soil/Initial stress=-1e5; -1e5; -1e5; 0",
                      "Bodies/soil/Material=sand"});
      advance_to(sample, 30.);
      const StressOf s(sample.points(), 0);
      const double   s_u = std::hypot(0.5 * (s.xx - s.yy), s.xy);
      gates.at_most(text("s_u, error / p'_0, psi = ", psi, " degrees"),
                    std::abs(s_u - exact) / 1e5,
                    1e-3);
    }
}



namespace
{
  /// Largest error over one turn in steps of a quarter, Pa.
  double
  turn(const Overrides &overrides)
  {
    Case<2> block("verification/rigid-rotation.prm", overrides);
    double  error = 0;
    for (unsigned int quarter = 1; quarter <= 4; ++quarter)
      {
        advance_to(block, 25. * quarter);
        const bool swapped = (quarter % 2 == 1);
        for_points(block, [&](const unsigned int p) {
          error = std::max(error,
                           StressOf(block.points(), p)
                             .distance(swapped ? -5e3 : -20e3,
                                       swapped ? -20e3 : -5e3,
                                       -8e3,
                                       swapped ? -3e3 : 3e3));
        });
      }
    return error;
  }
} // namespace



TEST(OnePoint, RigidRotation)
{
  const double tangent = turn({});
  // The velocity whose step ends where the rotation does.
  const std::string v     = "a*(x-xc)-b*(y-yc); b*(x-xc)+a*(y-yc)";
  Overrides         chord = {"Constants=w=2*pi/100; xc=0.5; yc=0.5; d=5e-3; "
                                     "a=(cos(w*d)-1)/d; b=sin(w*d)/d"};
  for (const std::string face : {"Left", "Right", "Bottom", "Top"})
    chord.push_back("Boundaries/" + face + " velocity=" + v);
  const double exact = turn(chord);
  Verification gates("Rigid rotation of stressed soil by 360 degrees",
                     "prm/verification/rigid-rotation.prm",
                     "the stress turns along");
  // A step along the tangent of the circle stretches by (w dt)^2/2.
  gates.near("error after a turn [Pa], from the step along the tangent",
             tangent,
             1e4 * 2. * M_PI * M_PI / 20000,
             1e-3);
  gates.at_most("error / stress, step along the chord", exact / 20e3, 1e-10);
}
