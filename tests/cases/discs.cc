// SPDX-License-Identifier: LGPL-2.1-or-later
// Two elastic discs collide and part, prm/verification/discs.prm.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// Share of the energy that the collision loses; the momentum that appears,
  /// relative to that of a disc, is written to @p momentum.
  double
  energy_lost(const std::string &cell_size, double &momentum)
  {
    const Table table = run<2>("verification/discs.prm",
                               "discs-" + cell_size,
                               {"Grid/Cell size=" + cell_size});
    const auto  total = [&](const unsigned int i) {
      return table["kinetic energy [J]"][i] + table["elastic energy [J]"][i];
    };
    momentum = 0;
    for (const double p : table["momentum x [kg m/s]"])
      momentum =
        std::max(momentum, std::abs(p) / (0.5 * table["mass [kg]"][0] * 0.1));
    return 1. - total(table.n_rows() - 1) / total(0);
  }



  /// Largest speed of a disc towards the other at the end, m/s, and the gap.
  std::array<double, 2>
  at_the_end()
  {
    Case<2> discs("verification/discs.prm", {});
    while (discs->state().time < 3.2)
      discs->advance();
    const Points<2>      &points = discs.points();
    std::array<double, 2> speed{}, reach{{-1e300, -1e300}};
    unsigned int          n = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const unsigned int body = points.data(points.body)[p];
        const double       side = (body == 0 ? 1. : -1.);
        n += body;
        speed[body] += side * points.data(points.velocity)[p];
        reach[body] = std::max(reach[body],
                               side *
                                 (points.data(points.position, 0)[p] +
                                  points.data(points.position, 1)[p] - 1.) /
                                 std::sqrt(2.));
      }
    return {{2. * std::max(speed[0], speed[1]) / points.size(),
             -(reach[0] + reach[1])}};
  }
} // namespace



TEST(Discs, CollideAndPart)
{
  Verification gates("Colliding elastic discs",
                     "prm/verification/discs.prm",
                     "conservation of momentum and energy");
  double       momentum, momentum_fine;
  const double coarse = energy_lost("0.025", momentum);
  const double fine   = energy_lost("0.0125", momentum_fine);
  gates.at_most("momentum that appears / that of a disc",
                std::max(momentum, momentum_fine),
                1e-12);
  gates.at_most("energy lost, h = 0.0125 m, share", fine, 0.02);
  gates.at_most("energy lost, h = 0.0125 m / h = 0.025 m", fine / coarse, 0.7);
  const auto [speed, gap] = at_the_end();
  gates.holds("speed towards each other [m/s], gap between them [m]",
              text(speed, ", ", gap),
              "below -0.08, above 0.05",
              speed < -0.08 && gap > 0.05);
}
