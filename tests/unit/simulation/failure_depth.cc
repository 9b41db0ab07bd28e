// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/failure_depth.h>

#include "../whole_problem.h"

namespace failure_depth_test
{
  struct Nothing
  {};

  /// Sentences on a mechanism in which all soil down to @p depth, m, below the
  /// mudline moves equally; points lie 0.125, 0.375, 0.625 and 0.875 m below.
  std::string
  note(const double depth, const std::string &entries = "")
  {
    const WholeProblem<Nothing> soil(entries);
    std::vector<double>         mechanism(2 * soil.points.size(), 0.);
    for (unsigned int p = 0; p < soil.points.size(); ++p)
      if (1. - soil.points.data(soil.points.position, 1)[p] < depth)
        {
          mechanism[2 * p]     = 3e-5;
          mechanism[2 * p + 1] = -4e-5;
        }
    talus::FailureDepth<2> failure;
    failure.record(mechanism);
    return failure.note(soil, soil.problem);
  }
} // namespace failure_depth_test



// Cells of 0.5 m. Less than two cells thick, the mechanism is compared with the
// weight of a cell per area, 0.5 m x 800 kg/m^3 x 9.81 m/s^2.
TEST(FailureDepth, DepthOfNineTenthsOfTheMotion)
{
  using failure_depth_test::note;
  EXPECT_EQ(note(2.),
            "Nine tenths of the mechanism lie within 1 m of the mudline, 2 "
            "cells.");
  EXPECT_EQ(
    note(0.2),
    "Nine tenths of the mechanism lie within 0.25 m of the mudline, 0.5 "
    "cells.");
  const std::string thin = note(0.5);
  EXPECT_TRUE(contains(thin, "within 0.5 m of the mudline, 1 cell.")) << thin;
  EXPECT_TRUE(contains(thin,
                       "strength of the moving soil is 5e+03 Pa, 1.27 of the "
                       "submerged weight of a cell per area, 3.92e+03 Pa."))
    << thin;
}



TEST(FailureDepth, NothingIsSaidWithoutMotionOrMudline)
{
  using failure_depth_test::note;
  EXPECT_EQ(note(0.), "");
  EXPECT_EQ(note(2., "set Initial displacement = 0.01*x; 0\n"), "");
}
