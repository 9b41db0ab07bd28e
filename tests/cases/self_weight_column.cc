// A soft column under its own weight, prm/verification/self-weight-column.prm.

#include "case.h"
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
  constexpr double  l0 = 50., weight = 80. * 10.; // m, N/m^3
  const std::string file   = "verification/self-weight-column.prm";
  const std::string source = "equilibrium: sigma_yy = -rho0 g (l0 - Y)";



  /// The column at rest, from the bottom up.
  struct AtRest
  {
    std::vector<double> Y;                // m, where the points were
    std::vector<double> talus;            // kPa, the stress that they bear
    std::vector<double> closed_form;      // kPa
    double              stress_error = 0; // of rho0 g l0, mean of the points
    double              height       = 0; // m
    double              unrest       = 0; // kinetic energy of the grid over
                                          // work of gravity
  };



  /// With @p n cells over the undeformed height.
  AtRest
  come_to_rest(const unsigned int n, const Overrides &overrides = {})
  {
    const std::string corner = text(l0 / n, ',', l0);
    Case<2>           column(file,
                   Overrides{text("Grid/Cell size=", l0 / n),
                             "Grid/Upper corner=" + corner,
                             "Bodies/column/Upper corner=" + corner} +
                     overrides);
    while (column->snapshot().time < 450.)
      column->advance();

    const Points<2> &points = column.points();
    const double    *Y      = points.data(points.initial_position, 1);
    const double    *stress = points.data(points.stress, stress_index<2>(1, 1));
    std::vector<unsigned int> order(points.size()); // all of one volume
    for (unsigned int p = 0; p < points.size(); ++p)
      order[p] = p;
    std::sort(order.begin(), order.end(), [&](const auto p, const auto q) {
      return Y[p] < Y[q];
    });
    AtRest result;
    for (const unsigned int p : order)
      {
        result.Y.push_back(Y[p]);
        result.talus.push_back(-1e-3 * stress[p]);
        result.closed_form.push_back(1e-3 * weight * (l0 - Y[p]));
        result.stress_error +=
          std::abs(result.talus.back() - result.closed_form.back()) /
          (1e-3 * weight * l0) / points.size();
      }
    const auto snapshot = column->snapshot();
    result.height       = points.data(points.position, 1)[order.back()] +
                    0.5 * box_length(snapshot, 1, order.back());
    result.unrest = snapshot.nodes.kinetic_energy() / snapshot.gravity_work;
    return result;
  }
} // namespace



TEST(SelfWeightColumn, Stress)
{
  Verification gates("Column under its own weight, rho0 g l0/E = 4, Hencky",
                     "prm/" + file,
                     source);
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
                     "prm/" + file + ", Materials/elastic/Law",
                     "integral of the stretch, see the file");
  const std::vector<std::pair<std::string, double>> heights = {
    {"linear elastic", 12.27105},
    {"neo-Hookean", 16.16959},
    {"Hencky", 24.05965}};
  for (const auto &[law, height] : heights)
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
