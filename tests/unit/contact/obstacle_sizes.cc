// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/obstacle_remarks.h>

#include "core_setup.h"
#include "obstacles_setup.h"

namespace
{
  using namespace talus;

  /// Parameters of a mesh of cells of 1 m.
  template <int dim>
  std::string
  cells_of_a_metre(const std::string &refinement_boxes)
  {
    return (dim == 2 ? mesh("0, 0", "8, 4") : mesh("0, 0, 0", "8, 4, 4")) +
           in_section("Grid", "set Refinement boxes = " + refinement_boxes);
  }



  /// Sentences for the log on an obstacle 'body' with these entries.
  template <int dim>
  std::vector<Remark>
  notes(const std::string &entries, const std::string &refinement_boxes = "")
  {
    const Core<dim>          core(cells_of_a_metre<dim>(refinement_boxes));
    const WithObstacles<dim> with({{"body", entries}});
    return check_obstacle_sizes(with.obstacles, core.grid);
  }



  /// The error for it, or nothing.
  template <int dim>
  std::string
  error(const std::string &entries, const std::string &refinement_boxes = "")
  {
    return message_of<ExcUser>(
      [&]() { notes<dim>(entries, refinement_boxes); });
  }

  const std::string small_ball = "Shape = ball|Centre = 3, 2|Radius = 0.4",
                    thin_wall =
                      "Shape = box|Lower corner = 3, 1|Upper corner = 3.1, 4",
                    thin_pipe = "Shape = box|Lower corner = 3, 1, -1|"
                                "Upper corner = 3.5, 1.75, 9";
} // namespace



TEST(ObstacleSizes, SmallerThanACell)
{
  const std::string sentence = error<2>(small_ball);
  for (const char *words : {"'body'",
                            "0.8 m along x and 0.8 m along y",
                            "less than a cell of 1 m",
                            "cells of 0.2 m or less",
                            "'Grid/Refinement boxes'"})
    EXPECT_TRUE(contains(sentence, words)) << words << " | " << sentence;
  // Where smaller cells are, and only there.
  EXPECT_EQ(error<2>(small_ball, "2,1; 4,3; 1"), "");
  EXPECT_NE(error<2>(small_ball, "6,1; 8,3; 1"), "");
}



// Soil goes around a wall on two sides, and around a pipe on four.
TEST(ObstacleSizes, ThinAlongOneAxisOrTwo)
{
  const auto remarks = notes<2>(thin_wall);
  ASSERT_EQ(remarks.size(), 1u);
  for (const char *words :
       {"'body'", "0.1 m along x", "two cells of 1 m", "0.025 m or less"})
    EXPECT_TRUE(contains(remarks[0].text(), words))
      << words << " | " << remarks[0].text();
  EXPECT_EQ(notes<3>("Shape = box|Lower corner = 3, 1, -1|"
                     "Upper corner = 3.1, 4, 9")
              .size(),
            1u);
  const std::string sentence = error<3>(thin_pipe);
  EXPECT_TRUE(contains(sentence, "0.5 m along x and 0.75 m along y"))
    << sentence;
}



TEST(ObstacleSizes, LargeOnes)
{
  EXPECT_TRUE(notes<2>("Shape = ball|Centre = 3, 2|Radius = 1").empty());
  EXPECT_TRUE(notes<2>("Shape = half-plane|Point = 0, 1").empty());
  EXPECT_TRUE(notes<3>("Shape = half-plane|Point = 0, 1, 0").empty());
}
