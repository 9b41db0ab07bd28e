// SPDX-License-Identifier: LGPL-2.1-or-later
// The column under its own weight and the cantilever of the dynamics, brought
// to equilibrium in load steps.

#include "column.h"
#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  const Overrides   standing_still = {"Stages=equilibrium",
                                      "Equilibrium/Strain=large",
                                      "Damping/Local damping=0"};
  const std::string column         = "verification/self-weight-column.prm";
  const Overrides   of_column =
    standing_still +
    Overrides{"Gravity/Ramp time=0", "Equilibrium/Load steps=200"};
  const std::string column_run =
    "prm/" + column + ", Stages = equilibrium, Strain = large, 200 load steps";



  StaticCase<2>
  find_column(const unsigned int n, const std::string &law)
  {
    return {column,
            text("implicit-column-", n),
            column_of(n) + of_column +
              Overrides{"Materials/elastic/Law=" + law}};
  }
} // namespace



TEST(ImplicitColumn, Stress)
{
  Verification gates("Column brought to equilibrium, rho0 g l0/E = 4, Hencky",
                     column_run,
                     "equilibrium: sigma_yy = -rho0 g (l0 - Y)");
  // What the best implicit code of the kind reaches.
  const std::vector<std::pair<unsigned int, double>> known = {{16, 3.7e-3},
                                                              {32, 1.05e-3},
                                                              {64, 4.4e-4}};
  Refinement                                         errors("implicit column");
  for (const auto &[n, limit] : known)
    {
      const StaticCase<2> found = find_column(n, "Hencky");
      const double        error = measure_column((*found).state()).stress_error;
      gates.at_most(text("mean error of the stress / rho0 g l0, ", n, " cells"),
                    error,
                    limit);
      errors.add(n, error);
    }
  errors.print();
  gates.at_least("order of the stress", errors.least_order(), 1.6, "about 2");
}



TEST(ImplicitColumn, Heights)
{
  Verification gates("Column brought to equilibrium, 64 cells",
                     column_run + ", Materials/elastic/Law",
                     "integral of the stretch, see the file");
  for (const auto &[law, height] : column_heights())
    {
      const StaticCase<2> found = find_column(64, law);
      gates.near("height at rest [m], " + law,
                 measure_column((*found).state()).height,
                 height,
                 0.005);
    }
}



// The consistent tangent: residuals of Newton's method are squared in each
// iteration.
TEST(ImplicitColumn, NewtonsMethodIsQuadratic)
{
  Verification gates("Newton's method on the column, 32 cells",
                     column_run + ", newton.csv",
                     "consistent tangent: r_{k+1} = C r_k^2");
  for (const auto &[law, height] : column_heights())
    {
      const StaticCase<2> found = find_column(32, law);
      gates.at_most("C, " + law + "; residuals of one load step: " +
                      a_sequence(found.newton(), 1e-3, 1e-6),
                    quadratic_constant(found.newton(), 1e-2, 1e-11),
                    100.,
                    "bounded");
    }
}



namespace
{
  constexpr double cantilever_length = 20.; // m

  struct DeadLoad
  {
    double Q;    // P L^2/(E I)
    double w, u; // deflections of the inextensible elastica over L
  };



  void
  hold(Verification   &gates,
       const DeadLoad &exact,
       const double    h,
       const double    limit)
  {
    const StaticCase<2> cantilever(
      "verification/elastica.prm",
      text("implicit-elastica-", exact.Q),
      standing_still +
        Overrides{text("Constants=Q = ", exact.Q, "; T = 1"),
                  "Body force/Expression=0; if(x > 19.875, -Q, 0)",
                  "Equilibrium/Load steps=50"});
    const Points<2> &points = cantilever.points();
    double           n = 0, u = 0, w = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      if (std::abs(points.data(points.initial_position, 0)[p] -
                   cantilever_length) < 0.5 * h)
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
          std::abs(value / n / cantilever_length - reference),
          limit,
          text("0 (found ", value / n / cantilever_length, ")"));
      };
    compare("w", w, exact.w);
    compare("u", u, exact.u);
  }



  const std::string elastica = "Elastica brought to equilibrium, L/b = 20, 4 "
                               "cells over the thickness",
                    run_of_elastica =
                      "prm/verification/elastica.prm, Stages = equilibrium, "
                      "Strain = large, 50 load steps",
                    dead_load_source =
                      "elliptic integrals of the inextensible elastica";
} // namespace



TEST(ImplicitElastica, LargestLoad)
{
  Verification gates(elastica, run_of_elastica, dead_load_source);
  hold(gates, {10., 0.81061, 0.55500}, 0.25, 0.005);
}



TEST(ImplicitElasticaLoads, Smaller)
{
  Verification gates(elastica, run_of_elastica, dead_load_source);
  hold(gates, {1., 0.30172, 0.05643}, 0.25, 0.005);
  hold(gates, {2., 0.49346, 0.16064}, 0.25, 0.005);
  hold(gates, {5., 0.71379, 0.38763}, 0.25, 0.005);
}
