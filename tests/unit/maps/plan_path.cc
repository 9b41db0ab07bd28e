// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/plan_path.h>

#include <gtest/gtest.h>

using namespace talus;
using dealii::Point;

TEST(PlanPath, MeasuresAlongItsBends)
{
  const PlanPath path({Point<2>(0., 0.), Point<2>(10., 0.), Point<2>(10., 5.)});
  EXPECT_DOUBLE_EQ(path.chainage(Point<2>(4., 1.)), 4.);
  EXPECT_DOUBLE_EQ(path.chainage(Point<2>(9., 4.)), 14.);
  // Outside of the bend the corner is the nearest place.
  EXPECT_DOUBLE_EQ(path.chainage(Point<2>(12., -1.)), 10.);
}



TEST(PlanPath, GoesOnBeyondItsEnds)
{
  const PlanPath path({Point<2>(0., 0.), Point<2>(-3., -4.)});
  EXPECT_DOUBLE_EQ(path.chainage(Point<2>(-6., -8.)), 10.);
  EXPECT_DOUBLE_EQ(path.chainage(Point<2>(3., 4.)), -5.);
}
