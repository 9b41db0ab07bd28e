// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/outline_surface.h>

#include <gtest/gtest.h>

using namespace talus;
using dealii::Point;

TEST(OutlineSurface, IsAsHighAsThePlaceIsInside)
{
  const OutlineSurface outline(
    "The outline",
    {Point<2>(0., 0.), Point<2>(10., 0.), Point<2>(10., 6.), Point<2>(0., 6.)});
  // Whatever the y of the place is.
  const auto inside = outline.at(Point<3>(4., -7., 2.));
  EXPECT_DOUBLE_EQ(inside.height, 2.);
  EXPECT_DOUBLE_EQ(inside.slope[0], 0.);
  EXPECT_DOUBLE_EQ(inside.slope[1], 0.);
  EXPECT_DOUBLE_EQ(inside.slope[2], 1.);
  const auto outside = outline.at(Point<3>(13., 0., 10.));
  EXPECT_DOUBLE_EQ(outside.height, -5.);
  EXPECT_DOUBLE_EQ(outside.slope[0], -0.6);
  EXPECT_DOUBLE_EQ(outside.slope[2], -0.8);
}
