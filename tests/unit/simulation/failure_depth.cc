// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/failure_depth.h>

#include "../whole_problem.h"

namespace failure_depth_test
{
  struct Nothing
  {};

  /// Sentences on a mechanism that moves by 5e-5 times share(depth in m) [m];
  /// points lie 0.125, 0.375, 0.625 and 0.875 m below the mudline.
  template <typename Share>
  std::vector<talus::Remark>
  notes(const Share &share, const std::string &entries = "")
  {
    const WholeProblem<Nothing> soil(entries);
    std::vector<double>         mechanism(2 * soil.points.size(), 0.);
    for (unsigned int p = 0; p < soil.points.size(); ++p)
      {
        const double moves =
          share(1. - soil.points.data(soil.points.position, 1)[p]);
        mechanism[2 * p]     = 3e-5 * moves;
        mechanism[2 * p + 1] = -4e-5 * moves;
      }
    talus::FailureDepth<2> failure;
    failure.record(mechanism);
    return failure.notes(soil, soil.problem, 2.);
  }



  /// First sentence on a mechanism in which all soil down to @p depth, m,
  /// moves equally; empty without sentences.
  std::string
  note(const double depth, const std::string &entries = "")
  {
    const auto all =
      notes([depth](const double y) { return y < depth ? 1. : 0.; }, entries);
    return all.empty() ? "" : all[0].sentence;
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



// Cells of 0.5 m, in soil 1 m thick. The stress of the row that shears at the
// base is that 0.75 m deep, three quarters of the stress at the base; a slip
// below the soil, and shear all over the thickness, are no such row.
TEST(FailureDepth, SingleRowThatShears)
{
  using failure_depth_test::notes;
  const auto row =
    notes([](const double y) { return std::min(1., 2. - 2. * y); });
  ASSERT_EQ(row.size(), 2u);
  const std::string told = row[1].text();
  EXPECT_EQ(row[1].severity, talus::Severity::look);
  EXPECT_TRUE(contains(told, "its middle, 0.75 m below the mudline")) << told;
  EXPECT_TRUE(contains(told, "1 m deep, the factor of safety is only 1.5."))
    << told;
  EXPECT_EQ(notes([](double) { return 1.; }).size(), 1u);
  EXPECT_EQ(notes([](const double y) { return y < 0.5 ? 1. : 0.; }).size(), 1u);
}
