// SPDX-License-Identifier: LGPL-2.1-or-later
// Ground at rest: stress by K0.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// Kinetic energy of the points over that of free fall, m (g t)^2/2, after
  /// the end of the run.
  template <int dim>
  double
  motion(Case<dim> &ground, const double g)
  {
    while (ground->state().time < 1. - 1e-12)
      ground->advance();
    const auto &points = ground.points();
    double      sum = 0, mass = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double m = points.data(points.mass)[p];
        mass += m;
        for (unsigned int d = 0; d < dim; ++d)
          sum += m * std::pow(points.data(points.velocity, d)[p], 2);
      }
    return sum / (mass * g * g);
  }



  /// Largest error of a component of the stress, Pa.
  template <int dim>
  double
  error_of_layers(const Points<dim> &points)
  {
    double error = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double y        = points.data(points.initial_position, 1)[p];
        const bool   is_upper = (points.data(points.body)[p] == 1.);
        const double vertical =
          is_upper ? -6e3 * (3. - y) : -6e3 - 1e4 * (2. - y);
        const double along = (is_upper ? 0.8 : 0.5) * vertical;
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          {
            const double exact = (c == 1 ? vertical : c < 3 ? along : 0.);
            error =
              std::max(error,
                       std::abs(points.data(points.stress, c)[p] - exact));
          }
      }
    return error;
  }



  template <int dim>
  void
  expect_layers_at_rest(const std::string &what,
                        const std::string &file,
                        const Overrides   &overrides,
                        const double       limit)
  {
    Case<dim>    ground(file, overrides);
    Verification gates("Two layers at rest, " + what,
                       "tests/cases/" + file,
                       "s_yy = weight above, s_xx = K0 s_yy, no motion");
    gates.at_most("stress, largest error / that at the bottom",
                  error_of_layers(ground.points()) / 26e3,
                  1e-13);
    gates.at_most("kinetic energy after 1 s / that of free fall",
                  motion(ground, 10.),
                  limit);
  }
} // namespace



TEST(Geostatic, LayersInPlaneStrain)
{
  expect_layers_at_rest<2>("2-D", "layers-at-rest.prm", {}, 1e-20);
}



TEST(Geostatic, LayersInSpace)
{
  expect_layers_at_rest<3>("3-D", "layers-at-rest-3d.prm", {}, 1e-20);
}



// Side by side, boxes of two sizes take the product of s_xx and dN/dx, both
// linear in y, at their centres; the errors do not cancel, so equilibrium is
// not exact.
TEST(Geostatic, LayersOnCellsOfTwoSizes)
{
  expect_layers_at_rest<2>("cells of two sizes",
                           "layers-at-rest.prm",
                           {"Grid/Refinement boxes=0,1; 0.7,2.5; 1",
                            "Grid/Upper corner=3,4",
                            "Bodies/lower/Upper corner=3,2",
                            "Bodies/upper/Upper corner=3,3"},
                           1e-8);
}



// A slope on a bed that is turned through the mesh has the stress of the same
// slope on the bottom of the mesh, turned; its depth is right to a part of a
// box, as its surface cuts boxes.
TEST(Geostatic, SlopeOnATurnedBed)
{
  const double      beta = 20 * M_PI / 180, H = 1., K0 = 0.8;
  const std::string file = "verification/block-on-plane.prm";
  for (const double degrees : {0., 17., 40.})
    {
      const double angle = degrees * M_PI / 180;
      const double c = std::cos(angle), s = std::sin(angle);
      const auto   place = [&](const double u, const double v) {
        return text(u * c + v * s, ",", v * c - u * s);
      };
      Case<2>     slab(file,
                   {text("Gravity/Slope angle=", 20 - degrees),
                        text("Bodies/block/Vertices=",
                         place(0, 0),
                         "; ",
                         place(8, 0),
                         "; ",
                         place(8, H),
                         "; ",
                         place(0, H)),
                        text("Bodies/block/K0=", K0),
                        text("Obstacles/plane/Normal=", s, ",", c)});
      const auto &points = slab.points();
      double      error = 0, mean = 0, n = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double x = points.data(points.initial_position, 0)[p];
          const double y = points.data(points.initial_position, 1)[p];
          const double u = x * c - y * s, v = x * s + y * c;
          if (u < 2 || u > 6) // beside the ends
            continue;
          const auto sigma = [&](const unsigned int i) {
            return points.data(points.stress, i)[p];
          };
          const double weight = 2000 * 9.81 * (H - v);
          // xx, yy, zz, xy to nn, tt, zz, tn
          const double errors[4] = {
            s * s * sigma(0) + c * c * sigma(1) + 2 * s * c * sigma(3) +
              weight * std::cos(beta),
            c * c * sigma(0) + s * s * sigma(1) - 2 * s * c * sigma(3) +
              K0 * weight * std::cos(beta),
            sigma(2) + K0 * weight * std::cos(beta),
            s * c * (sigma(0) - sigma(1)) + (c * c - s * s) * sigma(3) -
              weight * std::sin(beta)};
          for (const double e : errors)
            error = std::max(error, std::abs(e));
          mean += errors[0];
          ++n;
        }
      Verification gates(text("Slope at rest on a bed turned by ",
                              degrees,
                              " degrees"),
                         "prm/" + file + " with K0 = 0.8",
                         "s_nn = -rho g d cos, s_tn = rho g d sin, s_tt = s_zz "
                         "= K0 s_nn");
      gates.at_most("stress, largest error / that at the bottom",
                    error / (2000 * 9.81 * H),
                    degrees == 0 ? 1e-13 : 0.01);
      gates.at_most("stress, mean error / that at the bottom",
                    std::abs(mean) / n / (2000 * 9.81 * H),
                    degrees == 0 ? 1e-13 : 0.001);
    }
}



// The surface lies within a cell; the points up to it count.
TEST(Geostatic, InfiniteSlope)
{
  const std::string file = "verification/shear-layer.prm";
  for (const double height : {2., 1.85})
    {
      Case<2>      layer(file,
                    {"Boundaries/Bottom=fixed",
                          "Bodies/layer/Initial stress=",
                          "Bodies/layer/K0=0.8",
                          "Bodies/layer/Filling=centres",
                          text("Bodies/layer/Upper corner=0.75,", height)});
      const auto  &points = layer.points();
      const double H      = (height == 2. ? 2. : 1.875);
      const double g_x    = 9.81 * std::sin(M_PI / 36.);
      const double g_y    = -9.81 * std::cos(M_PI / 36.);
      double       error  = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double mass =
            1500. * (H - points.data(points.initial_position, 1)[p]);
          const double exact[4] = {0.8 * g_y * mass,
                                   g_y * mass,
                                   0.8 * g_y * mass,
                                   g_x * mass};
          for (unsigned int c = 0; c < 4; ++c)
            error =
              std::max(error,
                       std::abs(points.data(points.stress, c)[p] - exact[c]));
        }
      Verification gates(text("Infinite slope at rest, ", height, " m"),
                         "prm/" + file + " with K0 = 0.8 on a fixed bottom",
                         "s_yy = -rho g cos d, s_xy = rho g sin d, no motion");
      gates.at_most("stress, largest error / that at the bottom",
                    error / (1500. * 9.81 * H),
                    1e-13);
      gates.at_most("kinetic energy after 1 s / that of free fall",
                    motion(layer, 9.81),
                    1e-20);
    }
}
