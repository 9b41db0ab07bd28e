// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/refinement_boxes.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;

  const Box<2> domain{Point<2>(-1., 0.), Point<2>(3., 2.)};

  TEST(RefinementBoxes, AreReadInTheirOrder)
  {
    const auto boxes =
      parse_refinement_boxes<2>("-1, 0; 0.5, 2; 1 | 2,1; 3.5,4; 3", domain);
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_EQ(boxes[0].box.lower, Point<2>(-1., 0.));
    EXPECT_EQ(boxes[0].box.upper, Point<2>(0.5, 2.));
    EXPECT_EQ(boxes[0].n_levels, 1u);
    EXPECT_EQ(boxes[1].box.upper, Point<2>(3.5, 4.));
    EXPECT_EQ(boxes[1].n_levels, 3u);
    EXPECT_TRUE(parse_refinement_boxes<2>("", domain).empty());
  }



  // South-western and north-eastern corner: z points to the south.
  TEST(RefinementBoxes, OnTheMap)
  {
    const Box<3> mesh{Point<3>(0., -50., 0.), Point<3>(100., 0., 80.)};
    const PlaceCoordinates map(PlanCoordinates::map,
                               Point<3>(412000., 6538000., 20.));
    const auto             boxes =
      parse_refinement_boxes<3>("412010, 6537940, -15; 412030, 6537990, 0; 2",
                                mesh,
                                map);
    ASSERT_EQ(boxes.size(), 1u);
    EXPECT_EQ(boxes[0].box.lower, Point<3>(10., -35., 10.));
    EXPECT_EQ(boxes[0].box.upper, Point<3>(30., -20., 60.));
    EXPECT_TRUE(
      contains(message_of<ExcUser>([&]() {
                 parse_refinement_boxes<3>(
                   "412010, 6537990, -15; 412030, 6537940, 0; 2", mesh, map);
               }),
               "upper corner must lie above the lower one"));
  }



  TEST(RefinementBoxes, BoxesWithoutEffectAreRefused)
  {
    for (const std::string wrong : {"0,0; 1,1",     // how often?
                                    "0,0; 1,1; 11", // too often
                                    "0; 1,1; 1",    // a coordinate less
                                    "0,a; 1,1; 1",  // no number
                                    "1,0; 0,1; 1",  // upside down
                                    "3,0; 4,1; 1",  // only at the face
                                    "0,0; 1,1; 1 | 0,5; 1,6; 1"})
      EXPECT_TRUE(contains(message_of<ExcUser>([&]() {
                             parse_refinement_boxes<2>(wrong, domain);
                           }),
                           "'Grid/Refinement boxes = " + wrong + "'"))
        << wrong;
  }



  /// A common face is not enough, nor what round-off makes of it; a part of the
  /// volume is.
  TEST(RefinementBoxes, OverlapIsOfVolumes)
  {
    const RefinementBox<2> box{{Point<2>(0., 0.), Point<2>(1., 1.)}, 1};
    EXPECT_TRUE(overlap(box, Point<2>(0.9, -0.1), 0.2));
    EXPECT_TRUE(overlap(box, Point<2>(-1., -1.), 4.));
    EXPECT_FALSE(overlap(box, Point<2>(1., 0.), 0.2));
    EXPECT_FALSE(overlap(box, Point<2>(1. - 1e-12, 0.), 0.2));
    EXPECT_FALSE(overlap(box, Point<2>(0., -0.2 + 1e-12), 0.2));
    EXPECT_FALSE(overlap(box, Point<2>(0.5, 1.5), 0.2));
  }
} // namespace
