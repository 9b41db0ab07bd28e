// SPDX-License-Identifier: LGPL-2.1-or-later
// Signed distances and normals of all shapes: against closed forms, and against
// what defines them.

#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/pipe.h>
#include <talus/geometry/polygon.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;
  using Vertices = std::vector<Point<2>>;

  // Concave, with an acute corner.
  const Vertices corners = {{0., 0.}, {3., 0.}, {3., 2.5}, {1.2, 1.}, {0., 2.}};
  // A slope break, a trench and a run-out that rises a little.
  const Vertices seabed_vertices = {
    {-1., 2.}, {1., 1.}, {1.2, 0.2}, {2., 0.1}, {3., 0.4}};



  template <int dim>
  Point<dim>
  draw(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> number(-1., 4.);
    Point<dim>                             x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = number(random);
    return x;
  }



  /// What makes a function the Euclidean distance to the surface: where the
  /// normal leads, over the distance, there is the surface; nothing changes by
  /// more than the way; and the normal is the gradient wherever there is one.
  template <int dim>
  void
  expect_distance(const Shape<dim> &shape)
  {
    std::mt19937     random(1);
    unsigned int     n_smooth = 0;
    constexpr double epsilon  = 1e-5;
    for (unsigned int i = 0; i < 1000; ++i)
      {
        const Point<dim>     x = draw<dim>(random), y = draw<dim>(random);
        const double         distance = shape.signed_distance(x);
        const Tensor<1, dim> normal   = shape.normal(x);
        EXPECT_EQ(shape.contains(x), distance <= 0.);
        EXPECT_NEAR(normal.norm(), 1., 1e-14);
        EXPECT_NEAR(shape.signed_distance(x - distance * normal), 0., 1e-12);
        EXPECT_LE(std::abs(distance - shape.signed_distance(y)),
                  x.distance(y) + 1e-14);
        Tensor<1, dim> gradient;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const Tensor<1, dim> step = epsilon * Point<dim>::unit_vector(d);
            gradient[d]               = (shape.signed_distance(x + step) -
                           shape.signed_distance(x - step)) /
                          (2. * epsilon);
          }
        if (std::abs(gradient.norm() - 1.) < 1e-6)
          {
            ++n_smooth;
            EXPECT_LT((gradient - normal).norm(), 2e-3) << x;
          }
      }
    // Else the place lies within epsilon of a ridge.
    EXPECT_GE(n_smooth, 995u);
  }



  TEST(SignedDistance, IsEuclideanInThePlane)
  {
    const HalfSpace<2> half_plane(Point<2>(1., 0.5), Point<2>(1., 2.));
    expect_distance(half_plane);
    expect_distance(BoxRegion<2>({Point<2>(0.5, 0.), Point<2>(2., 3.)}));
    expect_distance(Ball<2>(Point<2>(1., 2.), 1.5));
    expect_distance(Ball<2>(Point<2>(1., 2.), 1.5, 0.7));
    expect_distance(Polygon("Vertices", corners));
    expect_distance(OpenPolygon("Vertices", seabed_vertices));
  }



  TEST(SignedDistance, IsEuclideanInSpace)
  {
    expect_distance(HalfSpace<3>(Point<3>(1., 1., 1.), Point<3>(-1., 2., 0.5)));
    expect_distance(
      BoxRegion<3>({Point<3>(0.5, 0., 1.), Point<3>(2., 3., 2.5)}));
    expect_distance(Ball<3>(Point<3>(1., 2., 1.5), 1.5, 0.7));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    expect_distance(
      Prism(std::make_unique<Ball<2>>(Point<2>(1., 2.), 1., 0.4), 0.5, 2.));
    expect_distance(Prism(std::make_unique<Ball<2>>(Point<2>(1., 2.), 1.),
                          -infinity,
                          infinity));
    expect_distance(
      Prism(std::make_unique<Polygon>("Vertices", corners), 0., 3.));
    expect_distance(
      Prism(std::make_unique<OpenPolygon>("Vertices", seabed_vertices),
            -infinity,
            infinity));
    expect_distance(Pipe({{0.5, 1., 0.}, {3., 2., 2.}}, 0.8));
    const Point<3> from(0.5, 1., 0.), to(2., 2., 2.);
    expect_distance(Frustum(from, to, 0.8, 0.8));
    expect_distance(Frustum(from, to, 0.4, 1.2));
    expect_distance(Frustum(from, to, 1.2, 0.));
    expect_distance(Frustum(from, to, 1., 1., 0.5));
  }



  TEST(SignedDistance, ClosedForms)
  {
    // By triangles with whole sides.
    const BoxRegion<2> box({Point<2>(0., 0.), Point<2>(10., 6.)});
    EXPECT_DOUBLE_EQ(box.signed_distance(Point<2>(13., 10.)), 5.);
    EXPECT_DOUBLE_EQ(box.signed_distance(Point<2>(4., 5.)), -1.);
    EXPECT_EQ(box.normal(Point<2>(4., 5.)), Point<2>(0., 1.));
    const HalfSpace<2> slope(Point<2>(1., 1.), Point<2>(3., 4.));
    EXPECT_DOUBLE_EQ(slope.signed_distance(Point<2>(4., 5.)), 5.);
    EXPECT_DOUBLE_EQ(slope.signed_distance(Point<2>(1., 0.)), -0.8);
    const Ball<3> shell(Point<3>(), 9., 3.);
    EXPECT_DOUBLE_EQ(shell.signed_distance(Point<3>(8., 8., 4.)), 3.);
    EXPECT_DOUBLE_EQ(shell.signed_distance(Point<3>(4., -2., 4.)), -3.);
    EXPECT_DOUBLE_EQ(shell.signed_distance(Point<3>()), 3.);
    EXPECT_EQ(shell.normal(Point<3>(0., 0., 2.)), Point<3>(0., 0., -1.));
    EXPECT_DOUBLE_EQ(Ball<2>(Point<2>(), 2.).signed_distance(Point<2>()), -2.);
    const Prism pipe(std::make_unique<Ball<2>>(Point<2>(), 2.), 0., 8.);
    EXPECT_DOUBLE_EQ(pipe.signed_distance(Point<3>(5., 0., 12.)), 5.);
    EXPECT_DOUBLE_EQ(pipe.signed_distance(Point<3>(0., 1., 3.)), -1.);
    // Upright, with a slope of 3 in 4.
    const Frustum cone(Point<3>(), Point<3>(0., 4., 0.), 3., 0.);
    EXPECT_DOUBLE_EQ(cone.signed_distance(Point<3>(5.5, 4., 0.)), 4.4);
    EXPECT_DOUBLE_EQ(cone.signed_distance(Point<3>(0., 1.5, 0.)), -1.5);
    EXPECT_EQ(cone.bounding_box().lower, Point<3>(-3., 0., -3.));
    EXPECT_EQ(cone.bounding_box().upper, Point<3>(3., 4., 3.));
  }



  // Above its corners, on its endless edges, and listed from the other side.
  TEST(SignedDistance, OpenPolygonIsBelowItsLine)
  {
    const Vertices    line = {{0., 3.}, {4., 0.}, {6., 0.}};
    const OpenPolygon bed("Vertices", line);
    EXPECT_DOUBLE_EQ(bed.signed_distance(Point<2>(1000., 7.)), 7.);
    EXPECT_DOUBLE_EQ(bed.signed_distance(Point<2>(1000., -7.)), -7.);
    EXPECT_NEAR(bed.signed_distance(Point<2>(-400. + 3., 303. + 4.)),
                5.,
                1e-12);
    EXPECT_NEAR(bed.signed_distance(Point<2>(3., -4.)),
                -std::hypot(1., 4.),
                1e-14);
    EXPECT_EQ(bed.normal(Point<2>(5., 0.)), Point<2>(0., 1.));
    EXPECT_EQ(bed.normal(Point<2>(5., -1.)), Point<2>(0., 1.));
    const OpenPolygon roof("Vertices", Vertices(line.rbegin(), line.rend()));
    std::mt19937      random(1);
    for (unsigned int i = 0; i < 100; ++i)
      {
        const auto x = draw<2>(random);
        EXPECT_NEAR(bed.signed_distance(x), -roof.signed_distance(x), 1e-14);
      }
  }



  TEST(SignedDistance, OpenPolygonsThatAreNoneAreRefused)
  {
    const auto error = [](const Vertices &vertices) -> std::string {
      try
        {
          OpenPolygon("The vertices", vertices);
        }
      catch (const ExcUser &error)
        {
          return error.what();
        }
      return "";
    };
    const auto expect = [&](const Vertices &vertices, const std::string &part) {
      const std::string said = error(vertices);
      EXPECT_NE(said.find(part), std::string::npos) << said;
    };
    expect({{0., 0.}}, "needs at least two");
    expect({{0., 0.}, {1., 0.}, {1., 0.}, {2., 0.}}, "twice in a row");
    expect({{0., 0.}, {2., 0.}, {2., 1.}, {1., -1.}}, "crosses itself");
    // Only where the ends go on.
    expect({{0., 0.}, {1., 1.}, {2., 1.}, {3., 0.}, {-5., -0.5}},
           "crosses itself");
    EXPECT_EQ(error(seabed_vertices), "");
  }
} // namespace
