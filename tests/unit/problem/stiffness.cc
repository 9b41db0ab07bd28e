// SPDX-License-Identifier: LGPL-2.1-or-later
// Soil that is too soft for its weight or strength is remarked.

#include <talus/problem/stiffness.h>

#include "../whole_problem.h"

#include <gtest/gtest.h>

namespace stiffness_test
{
  struct Nothing
  {};

  constexpr double weight = 800. * 9.81 * 1.; ///< rho' g H, Pa



  /// Return the remark on soil of Poisson's ratio @p nu whose weight is
  /// @p share of Young's modulus; empty if there is none.
  std::string
  remark(const double       share,
         const double       nu,
         const std::string &more     = "",
         const std::string &stronger = "")
  {
    WholeProblem<Nothing> soil(
      "",
      in_section("Materials",
                 in_section("clay",
                            talus::text("set Young's modulus = ",
                                        weight / share,
                                        "\nset Poisson's ratio = ",
                                        nu,
                                        "\n",
                                        stronger))) +
        more);
    for (const talus::Remark &note : soil.problem.remarks(0.5))
      if (contains(note.sentence, "too soft"))
        return note.text();
    return "";
  }
} // namespace stiffness_test



// G = E/(2 (1 + nu)) and K = E/(3 (1 - 2 nu)).
TEST(Stiffness, SoftSoilIsRemarked)
{
  using namespace stiffness_test;
  EXPECT_EQ(remark(0.49 / 2.9, 0.45), "");
  const std::string said = remark(1. / 2.9, 0.45);
  EXPECT_TRUE(contains(said, "rho' g H/G = 1 where at most 0.5")) << said;
  EXPECT_TRUE(contains(said, "2.02 times larger, 4.6e+04 Pa")) << said;
  EXPECT_EQ(remark(weight / 4.597e4, 0.45), "");
  // Drained soil is compressed first.
  EXPECT_EQ(remark(0.098 / 1.2, 0.3), "");
  const std::string compressed = remark(0.15, 0.3);
  EXPECT_TRUE(contains(compressed, "H/K = 0.18 where")) << compressed;
  EXPECT_FALSE(contains(compressed, "H/G")) << compressed;
}



TEST(Stiffness, LoadsThatCount)
{
  using namespace stiffness_test;
  const std::string weightless = in_section("Gravity", "set Magnitude = 0");
  EXPECT_EQ(remark(1., 0.45, weightless, "set Undrained shear strength = 1000"),
            "");
  const std::string strong =
    remark(0.1, 0.45, weightless, "set Undrained shear strength = 27000");
  EXPECT_TRUE(contains(strong, "s_u/G = 0.998 where at most 0.5")) << strong;
}
