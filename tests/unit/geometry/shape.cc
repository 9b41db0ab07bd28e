// SPDX-License-Identifier: LGPL-2.1-or-later
// The shapes that bodies have: what lies in them, and the boxes around them.

#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/polygon.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace
{
  using namespace talus;
  using dealii::Point;
  using Vertices = std::vector<Point<2>>;

  // Concave, with a corner between two lattice points of an axis and sloping
  // edges that lattice points lie on.
  const Vertices concave = {{0, 0}, {8, 0}, {8, 6}, {4, 2}, {0, 5}};



  Polygon
  polygon(const Vertices &vertices)
  {
    return Polygon("The vertices", vertices);
  }



  /// What the user is told if the vertices form no polygon.
  std::string
  error(const Vertices &vertices)
  {
    try
      {
        polygon(vertices);
      }
    catch (const ExcUser &error)
      {
        return error.what();
      }
    return "";
  }



  /// By the shoelace formula.
  double
  area(const Vertices &v)
  {
    double twice = 0.;
    for (std::size_t i = 0; i < v.size(); ++i)
      {
        const auto &a = v[i], &b = v[(i + 1) % v.size()];
        twice += a[0] * b[1] - b[0] * a[1];
      }
    return 0.5 * std::abs(twice);
  }



  /// Number of points with whole coordinates on the edges.
  unsigned int
  n_on_edges(const Vertices &v)
  {
    unsigned int n = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      {
        const auto &a = v[i], &b = v[(i + 1) % v.size()];
        n += std::gcd(static_cast<int>(b[0] - a[0]),
                      static_cast<int>(b[1] - a[1]));
      }
    return n;
  }



  unsigned int
  n_inside(const Polygon &shape)
  {
    unsigned int n = 0;
    for (int i = -2; i <= 12; ++i)
      for (int j = -2; j <= 12; ++j)
        n += shape.contains(Point<2>(i, j));
    return n;
  }



  // Pick's theorem: a polygon with corners of whole coordinates contains
  // A + B/2 + 1 points with whole coordinates, the B on its edges included.
  TEST(Shape, PolygonContainsItsEdges)
  {
    const double expected = area(concave) + 0.5 * n_on_edges(concave) + 1.;
    EXPECT_EQ(n_inside(polygon(concave)), expected);
    for (const auto &vertex : concave)
      EXPECT_TRUE(polygon(concave).contains(Point<2>(vertex[0], vertex[1])));
  }



  TEST(Shape, PolygonInEitherSense)
  {
    Vertices other = concave, closed = concave;
    std::reverse(other.begin(), other.end());
    closed.push_back(concave.front());
    EXPECT_EQ(n_inside(polygon(other)), n_inside(polygon(concave)));
    EXPECT_EQ(n_inside(polygon(closed)), n_inside(polygon(concave)));
  }



  TEST(Shape, PolygonEndsAtItsEdges)
  {
    constexpr double epsilon = 1e-9;
    const auto       shape   = polygon(concave);
    EXPECT_TRUE(shape.contains(Point<2>(8. - epsilon, 3.)));
    EXPECT_FALSE(shape.contains(Point<2>(8. + epsilon, 3.)));
    // Beside the corner that points inwards.
    EXPECT_TRUE(shape.contains(Point<2>(4., 2. - epsilon)));
    EXPECT_FALSE(shape.contains(Point<2>(4., 2. + epsilon)));
    const auto box = shape.bounding_box();
    EXPECT_EQ(box.lower, Point<2>(0., 0.));
    EXPECT_EQ(box.upper, Point<2>(8., 6.));
  }



  // A comb of many teeth: tooth k covers x from k to k + 1/2. A query that
  // tests all edges would take minutes in sum.
  TEST(Shape, PolygonOfManyCorners)
  {
    constexpr unsigned int n_teeth = 50000;
    std::vector<Point<2>>  vertices{{0., 0.}};
    for (unsigned int k = 0; k < n_teeth; ++k)
      for (const auto &[x, y] : {std::pair(0., 2.),
                                 std::pair(0.5, 2.),
                                 std::pair(0.5, 1.),
                                 std::pair(1., 1.)})
        vertices.emplace_back(k + x, y);
    vertices.emplace_back(n_teeth, 0.);
    const Polygon comb = polygon(vertices);
    EXPECT_EQ(comb.bounding_box().upper, Point<2>(n_teeth, 2.));
    for (unsigned int k = 1; k + 1 < n_teeth; ++k)
      {
        EXPECT_TRUE(comb.contains(Point<2>(k + 0.25, 1.5)));
        EXPECT_TRUE(comb.contains(Point<2>(k + 0.5, 1.5)));
        EXPECT_FALSE(comb.contains(Point<2>(k + 0.75, 1.5)));
        EXPECT_NEAR(comb.signed_distance(Point<2>(k + 0.25, 1.9)), -0.1, 1e-12);
        EXPECT_NEAR(comb.signed_distance(Point<2>(k + 0.75, 1.2)), 0.2, 1e-12);
        EXPECT_EQ(comb.normal(Point<2>(k + 0.75, 1.2)), Point<2>(0., 1.));
      }
    EXPECT_DOUBLE_EQ(comb.signed_distance(Point<2>(-3., -4.)), 5.);
    EXPECT_FALSE(comb.contains(Point<2>(std::nan(""), 1.)));
  }



  TEST(Shape, PolygonsThatAreNoneAreRefused)
  {
    const Vertices crossing = {{0, 0}, {2, 2}, {2, 0}, {0, 2}};
    const Vertices flat     = {{0, 0}, {2, 2}, {1, 1}};
    for (const Vertices &vertices : {crossing, flat, Vertices{{0, 0}}})
      {
        const std::string said = error(vertices);
        EXPECT_NE(said.find("The vertices do not form a simple polygon: "),
                  std::string::npos)
          << said;
      }
    EXPECT_EQ(error(concave), "");
  }



  TEST(Shape, PrismOverAPolygon)
  {
    const Prism prism(std::make_unique<Polygon>("The vertices", concave),
                      -1.,
                      2.);
    for (const double z : {-1., 0.5, 2.})
      {
        EXPECT_TRUE(prism.contains(Point<3>(1., 1., z))) << z;
        EXPECT_FALSE(prism.contains(Point<3>(4., 3., z))) << z;
      }
    for (const double z : {-1.001, 2.001})
      EXPECT_FALSE(prism.contains(Point<3>(1., 1., z))) << z;
    const auto box = prism.bounding_box();
    EXPECT_EQ(box.lower, Point<3>(0., 0., -1.));
    EXPECT_EQ(box.upper, Point<3>(8., 6., 2.));
  }



  TEST(Shape, BoxContainsItsCorners)
  {
    const Box<3>       box{Point<3>(-1., 0., 2.), Point<3>(1., 3., 4.)};
    const BoxRegion<3> shape(box);
    constexpr double   above_one = 1. + std::numeric_limits<double>::epsilon();
    EXPECT_TRUE(shape.contains(box.lower));
    EXPECT_TRUE(shape.contains(box.upper));
    EXPECT_TRUE(shape.contains(Point<3>(1., 0., 3.)));
    EXPECT_FALSE(shape.contains(Point<3>(above_one, 0., 3.)));
    EXPECT_FALSE(shape.contains(Point<3>(0., 3., 2. - 1e-15)));
    EXPECT_EQ(shape.bounding_box().lower, box.lower);
    EXPECT_EQ(shape.bounding_box().upper, box.upper);
  }



  // Distances by triangles with whole sides.
  TEST(Shape, BallContainsItsSurfaces)
  {
    const Ball<2> ring(Point<2>(1., 2.), 10., 5.);
    EXPECT_TRUE(ring.contains(Point<2>(7., 10.)));
    EXPECT_FALSE(ring.contains(Point<2>(7.001, 10.)));
    EXPECT_TRUE(ring.contains(Point<2>(4., 6.)));
    EXPECT_FALSE(ring.contains(Point<2>(3.999, 6.)));
    EXPECT_FALSE(ring.contains(Point<2>(1., 2.)));
    EXPECT_EQ(ring.bounding_box().lower, Point<2>(-9., -8.));
    EXPECT_EQ(ring.bounding_box().upper, Point<2>(11., 12.));

    const Ball<3> ball(Point<3>(), 3., 0.);
    EXPECT_TRUE(ball.contains(Point<3>()));
    EXPECT_TRUE(ball.contains(Point<3>(1., -2., 2.)));
    EXPECT_FALSE(ball.contains(Point<3>(1., -2., 2.001)));
  }
} // namespace
