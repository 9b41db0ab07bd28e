// SPDX-License-Identifier: LGPL-2.1-or-later
// Numerical fracture on demand, prm/verification/hanging-block.prm.

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
  constexpr double  end = 1.6; // s, before torn pieces reach the far end
  const std::string hanging_block_file = "verification/hanging-block.prm";
  const std::string end_set            = text("End time=", end);

  double
  largest_of(const std::vector<double> &values)
  {
    return *std::max_element(values.begin(), values.end());
  }



  /// Along x: the length of row x of F, as square points have it.
  double
  largest_stretch()
  {
    Case<2> block(hanging_block_file, {end_set});
    double  result = 0;
    while (block->state().time < end)
      {
        block->advance();
        const Points<2>   &points = block.points();
        const unsigned int F      = points.find("deformation gradient");
        for (unsigned int p = 0; p < points.size(); ++p)
          result =
            std::max(result,
                     std::hypot(points.data(F, 0)[p], points.data(F, 1)[p]));
      }
    return result;
  }
} // namespace



TEST(HangingBlock, TearsOnlyWithoutSplitting)
{
  Verification gates("Hanging block under sudden gravity",
                     "prm/" + hanging_block_file,
                     "a hyperelastic body cannot tear");
  gates.at_least("largest stretch", largest_stretch(), 2.5, "above 2.5");
  const auto &state = [&](const std::string &name, const Overrides &overrides) {
    const Table table =
      run<2>(hanging_block_file, name, Overrides{end_set} + overrides);
    return std::array<double, 2>{{largest_of(table["empty columns"]),
                                  largest_of(table["connected bodies"])}};
  };
  const auto whole = state("hanging-block", {});
  gates.holds("with splitting: empty columns, bodies, at most",
              text(whole[0], ", ", whole[1]),
              "0, 1",
              whole[0] == 0 && whole[1] == 1);
  const auto torn = state("hanging-block-unsplit", {"Splitting/Enabled=false"});
  gates.holds("without: empty columns, bodies, at most",
              text(torn[0], ", ", torn[1]),
              "tears: more than 0, more than 1",
              torn[0] > 0 && torn[1] > 1);
}
