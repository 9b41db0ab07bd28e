// SPDX-License-Identifier: LGPL-2.1-or-later
// A cantilever bends by up to 80 degrees, prm/verification/elastica.prm.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double  L = 20., h = 0.25; // m
  const std::string elastica_file = "verification/elastica.prm";

  /// Load, deflections of the inextensible elastica, and when it rests.
  struct Elastica
  {
    double Q;    // P L^2/(E I)
    double w, u; // over L
    double end;  // s
  };



  void
  hold(Verification &gates, const Elastica &exact, const double limit)
  {
    Case<2> cantilever(elastica_file,
                       {text("Constants=Q = ", exact.Q, "; T = 71.5"),
                        text("End time=", exact.end)});
    while (cantilever->state().time < exact.end)
      cantilever->advance();

    const auto      &state  = cantilever->state();
    const Points<2> &points = state.points;
    double           n = 0, u = 0, w = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      if (std::abs(points.data(points.initial_position, 0)[p] - L) < 0.5 * h)
        {
          ++n;
          u += points.data(points.initial_position, 0)[p] -
               points.data(points.position, 0)[p];
          w += points.data(points.initial_position, 1)[p] -
               points.data(points.position, 1)[p];
        }
    ASSERT_GT(n, 0);
    const auto compare =
      [&](const std::string &name, const double value, const double reference) {
        gates.at_most(
          text("|", name, "/L - ", reference, "|, P L^2/EI = ", exact.Q),
          std::abs(value / n / L - reference),
          limit,
          text("0 (found ", value / n / L, ")"));
      };
    compare("w", w, exact.w);
    compare("u", u, exact.u);
    EXPECT_LT(state.nodes.kinetic_energy() /
                state.accounts.energy("gravity work"),
              1e-4);
  }



  const std::string name = "Elastica, L/b = 20, 4 cells over the thickness",
                    elastica_source =
                      "elliptic integrals of the inextensible elastica";
} // namespace



TEST(Elastica, LargestLoad)
{
  Verification gates(name, "prm/" + elastica_file, elastica_source);
  hold(gates, {10., 0.81061, 0.55500, 143.}, 0.005);
}



TEST(ElasticaLoads, Smaller)
{
  Verification gates(name,
                     "prm/" + elastica_file + ", Constants",
                     elastica_source);
  hold(gates, {1., 0.30172, 0.05643, 229.}, 0.01);
  hold(gates, {2., 0.49346, 0.16064, 186.}, 0.01);
  hold(gates, {5., 0.71379, 0.38763, 157.}, 0.01);
}
