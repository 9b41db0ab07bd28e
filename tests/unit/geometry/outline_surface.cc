// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/outline_surface.h>

#include <gtest/gtest.h>

using namespace talus;
using dealii::Point;

namespace
{
  const std::vector<Point<2>> square   = {{10., 0.},
                                          {20., 0.},
                                          {20., 6.},
                                          {10., 6.}};
  const std::vector<Point<2>> triangle = {{30., 0.}, {40., 0.}, {30., 8.}};
} // namespace



TEST(OutlineSurface, IsAsHighAsThePlaceIsInside)
{
  // z points to the south.
  const OutlineSurface<3> outline("The outline",
                                  {square},
                                  {},
                                  Point<3>(10., 6., 0.));
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



TEST(OutlineSurface, AlongASection)
{
  // From the south-west to the north-east through a corner of the square, then
  // to the east.
  const OutlineSurface<2> outline("The outline",
                                  {square},
                                  {},
                                  {Point<3>(1e6, 1e6, 0.),
                                   {{7., -4.}, {13., 4.}, {60., 4.}}});
  const auto              before = outline.at(Point<2>(0., 3.));
  EXPECT_DOUBLE_EQ(before.height, -5.);
  EXPECT_DOUBLE_EQ(before.slope[0], 0.6 * 0.6 + 0.8 * 0.8);
  const auto inside = outline.at(Point<2>(15., 3.));
  EXPECT_DOUBLE_EQ(inside.height, 2.);
  EXPECT_DOUBLE_EQ(outline.at(Point<2>(10. + 6.5, 0.)).height, 0.5);
  EXPECT_DOUBLE_EQ(outline.at(Point<2>(10. + 6.5, 0.)).slope[0], -1.);
}



TEST(OutlineSurface, NumberOfTheNearestOfSeveral)
{
  const Point<3>          north_west;
  const OutlineSurface<3> distance("The areas",
                                   {square, triangle},
                                   {},
                                   north_west);
  const OutlineSurface<3> depth("The areas",
                                {square, triangle},
                                {5., 9.},
                                north_west);
  for (const auto &[easting, height, number] : {std::make_tuple(19., 1., 5.),
                                                std::make_tuple(24., -4., 5.),
                                                std::make_tuple(26., -4., 9.),
                                                std::make_tuple(31., 1., 9.)})
    {
      const Point<3> x(easting, 0., -3.);
      EXPECT_DOUBLE_EQ(distance.at(x).height, height);
      EXPECT_DOUBLE_EQ(depth.at(x).height, number);
      EXPECT_EQ(depth.at(x).slope.norm(), 0.);
      EXPECT_DOUBLE_EQ(depth.largest_change(x, 1.), 4.);
    }
}
