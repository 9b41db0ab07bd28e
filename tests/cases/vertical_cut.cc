// SPDX-License-Identifier: LGPL-2.1-or-later
// A vertical cut in clay, prm/verification/vertical-cut.prm.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double  height = 5., ramp_time = 1.5, end_of_cut = 5.; // m, s, s
  constexpr double  enough = 2e-3; // settlement over H that ends a run
  const std::string vertical_cut_file = "verification/vertical-cut.prm";
  const std::string vertical_cut_source =
    "limit analysis: 3.776 <= N_c <= 3.83";

  /// What became of a cut. It stands if the soil comes to rest, and collapses
  /// if the crest settles by more than five times as much as in elastic soil.
  /// There is a gap between the two: cuts that come to rest have settled by up
  /// to 2.5 times as much. A cut that still creeps at the end does not stand.
  /// (In softer soil also cuts that collapse come to rest before that, since
  /// they harden by their change of shape.)
  struct Outcome
  {
    double settlement = 0;        ///< of the crest at the end, over H
    double elastic    = 0;        ///< the same in elastic soil
    double energy     = INFINITY; ///< kinetic at the end, over its maximum

    bool
    stands() const
    {
      return energy < 1e-6 && settlement < 5. * elastic;
    }

    bool
    collapses() const
    {
      return settlement > 5. * elastic;
    }

    std::string
    str() const
    {
      return text(stands()      ? "stands"
                  : collapses() ? "collapses"
                                : "creeps",
                  ", settlement ",
                  settlement / elastic,
                  " of the elastic one");
    }
  };



  /// Name of the point nearest to the crest, (0, H).
  double
  find_crest(const Points<2> &points)
  {
    const double *x       = points.data(points.initial_position, 0);
    const double *y       = points.data(points.initial_position, 1);
    unsigned int  nearest = 0;
    for (unsigned int p = 1; p < points.size(); ++p)
      if (std::hypot(x[p], y[p] - height) <
          std::hypot(x[nearest], y[nearest] - height))
        nearest = p;
    return points.data(points.id)[nearest];
  }



  double
  settlement(const Points<2> &points, const double crest)
  {
    const double      *id = points.data(points.id);
    const unsigned int p  = std::find(id, id + points.size(), crest) - id;
    return (points.data(points.initial_position, 1)[p] -
            points.data(points.position, 1)[p]) /
           height;
  }



  /// Let gravity grow until gamma H/s_u is @p load, and wait until the soil is
  /// at rest, or to the end time. The cells are of H / @p cells. The elastic
  /// settlement is twice that under half of the weight, where soil yields at
  /// the toe at most.
  Outcome
  excavate(const double load, const unsigned int cells)
  {
    Case<2>      cut(vertical_cut_file,
                {text("Gravity/Magnitude=", load),
                      text("Grid/Cell size=", height / cells)});
    const double crest = find_crest(cut.points());
    Outcome      result;
    double       most_energy = 0, time = 0;
    while (time < end_of_cut && result.settlement < enough &&
           !(time > ramp_time && result.stands()))
      {
        for (unsigned int i = 0; i < 50 && cut->state().time < end_of_cut; ++i)
          cut->advance();
        time                = cut->state().time;
        const double energy = cut->state().nodes.kinetic_energy();
        most_energy         = std::max(most_energy, energy);
        result.energy       = energy / most_energy;
        result.settlement   = settlement(cut.points(), crest);
        if (time < 0.5 * ramp_time)
          result.elastic = 2. * result.settlement;
      }
    std::cout << "cut, gamma H/s_u = " << load << ", cells of H/" << cells
              << ": t = " << time << " s, " << result.str() << std::endl;
    return result;
  }



  /// Middle of the bracket of the critical load, which is 0.05 wide; writes
  /// the settlement over the load.
  double
  critical_load(const unsigned int cells)
  {
    std::map<double, double> settlements;
    const auto               stands = [&](const double load) {
      const Outcome outcome = excavate(load, cells);
      settlements[load]     = outcome.settlement;
      return outcome.stands();
    };
    double lower = 3.4, upper = 4.2;
    EXPECT_TRUE(stands(3.0));
    EXPECT_TRUE(stands(lower));
    EXPECT_FALSE(stands(upper));
    while (upper - lower > 0.051)
      {
        const double middle              = 0.5 * (lower + upper);
        (stands(middle) ? lower : upper) = middle;
      }
    std::vector<double> load, settlement;
    for (const auto &pair : settlements)
      {
        load.push_back(pair.first);
        settlement.push_back(pair.second);
      }
    Verification::write_series(text("vertical-cut-", cells),
                               {{"gamma H / s_u", load},
                                {"final crest settlement / H", settlement}});
    return 0.5 * (lower + upper);
  }
} // namespace



TEST(VerticalCut, StandsAndCollapses)
{
  Verification  gates("Vertical cut in clay, cells of H/16",
                     "prm/" + vertical_cut_file,
                     vertical_cut_source);
  const Outcome below = excavate(3.6, 16), above = excavate(4.0, 16);
  gates.holds("gamma H / s_u = 3.6", below.str(), "stands", below.stands());
  gates.holds("gamma H / s_u = 4.0",
              above.str(),
              "collapses",
              above.collapses());
}



TEST(VerticalCutBracket, CriticalLoad)
{
  Verification gates("Vertical cut in clay: critical load",
                     "prm/" + vertical_cut_file +
                       " Gravity/Magnitude=3.6 ... 4.2",
                     vertical_cut_source);
  const auto   name = [](const unsigned int cells) {
    return text("critical gamma H / s_u, cells of H/", cells);
  };
  gates.falls_short(name(8),
                    critical_load(8),
                    1.03 * 3.80,
                    {4.05,
                     "the slip surface is smeared over some cells: as with "
                     "finite elements the load is too high, by about half as "
                     "much on cells of half the size"},
                    "3.80");
  for (const unsigned int cells : {16, 32})
    gates.near(name(cells), critical_load(cells), 3.80, 0.03);
}
