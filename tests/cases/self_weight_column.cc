// SPDX-License-Identifier: LGPL-2.1-or-later
// A soft column under its own weight, prm/verification/self-weight-column.prm.

#include "column.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string column_file   = "verification/self-weight-column.prm";
  const std::string column_source = "equilibrium: sigma_yy = -rho0 g (l0 - Y)";



  struct AtRest : public ColumnAtRest
  {
    double unrest; // kinetic energy of the grid over work of gravity
  };



  /// With @p n cells over the undeformed height.
  AtRest
  come_to_rest(const unsigned int n, const Overrides &overrides = {})
  {
    Case<2> column(column_file, column_of(n) + overrides);
    while (column->state().time < 450.)
      column->advance();
    const auto &state = column->state();
    return {measure_column(state),
            state.nodes.kinetic_energy() /
              state.accounts.energy("gravity work")};
  }
} // namespace



TEST(SelfWeightColumn, Stress)
{
  Verification gates("Column under its own weight, rho0 g l0/E = 4, Hencky",
                     "prm/" + column_file,
                     column_source);
  // What the best implicit code of the kind reaches.
  const std::vector<std::pair<unsigned int, double>> known = {{16, 3.7e-3},
                                                              {32, 1.05e-3},
                                                              {64, 4.4e-4}};
  Refinement                                         errors("column");
  double                                             unrest = 0;
  for (const auto &[n, limit] : known)
    {
      const AtRest column = come_to_rest(n);
      Verification::write_series(text("column-", n),
                                 {{"height", column.Y},
                                  {"talus", column.talus},
                                  {"closed form", column.closed_form}});
      gates.at_most(text("mean error of the stress / rho0 g l0, ", n, " cells"),
                    column.stress_error,
                    limit);
      errors.add(n, column.stress_error);
      unrest = std::max(unrest, column.unrest);
    }
  errors.print();
  gates.at_least("order of the stress", errors.least_order(), 1.6, "about 2");
  gates.at_most("kinetic energy of the grid / work of gravity at the end",
                unrest,
                1e-9);
}



TEST(SelfWeightColumn, Heights)
{
  Verification gates("Column under its own weight, 64 cells",
                     "prm/" + column_file + ", Materials/elastic/Law",
                     "integral of the stretch, see the file");
  for (const auto &[law, height] : column_heights())
    gates.near("height at rest [m], " + law,
               come_to_rest(64, {"Materials/elastic/Law=" + law}).height,
               height,
               0.005);
}



/// The control: boxes that are clipped overlap, and the error stalls.
TEST(SelfWeightColumn, ClippedBoxesStall)
{
  const Overrides clipped = {"Transfer/Minimum half-size=0.1"};
  const double    coarse  = come_to_rest(32, clipped).stress_error;
  const double    fine    = come_to_rest(64, clipped).stress_error;
  std::cout << "clipped boxes: errors " << coarse << ' ' << fine << '\n';
  EXPECT_GT(fine, 2e-3);
  EXPECT_LT(std::log2(coarse / fine), 1.);
}
