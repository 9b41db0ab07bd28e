// SPDX-License-Identifier: LGPL-2.1-or-later
// Depth below the upper surface of the soil.

#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/polygon.h>
#include <talus/problem/mudline.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace talus;
using dealii::Point;
using dealii::Tensor;

namespace
{
  template <int dim, typename... Shapes>
  Mudline<dim>
  mudline_of(const Box<dim> &domain, Shapes... shapes)
  {
    typename Mudline<dim>::Bodies bodies;
    (bodies.push_back(std::make_unique<Shapes>(std::move(shapes))), ...);
    return {std::move(bodies), domain};
  }
} // namespace



// A layer on a disc: the depth in the lower body is that below the upper one,
// as far as that reaches.
TEST(Mudline, OfAllBodies)
{
  const auto mudline = mudline_of<2>({Point<2>(-20., -10.), Point<2>(20., 10.)},
                                     Ball<2>(Point<2>(0., 0.), 5.),
                                     Polygon("The vertices",
                                             {Point<2>(-8., 6.),
                                              Point<2>(2., 6.),
                                              Point<2>(2., 9.),
                                              Point<2>(-8., 7.)}));
  const double tolerance = 1e-10;
  const auto   surface   = [](const double x) { return 7. + 0.2 * (x + 8.); };
  for (const double x : {-7.9, -3., 0., 1.999})
    EXPECT_NEAR(mudline.depth(Point<2>(x, 6.5)), surface(x) - 6.5, tolerance);
  for (const double x : {-3., 0., 1.5})
    EXPECT_NEAR(mudline.depth(Point<2>(x, -1.)), surface(x) + 1., tolerance);
  for (const double x : {2.001, 3., 4.9})
    EXPECT_NEAR(mudline.depth(Point<2>(x, 0.)),
                std::sqrt(25. - x * x),
                tolerance);
  EXPECT_EQ(mudline.depth(Point<2>(6., 0.)), 0.);
}



// Soil that goes on beyond the top of the mesh begins there.
TEST(Mudline, EndsWithTheMesh)
{
  const auto mudline =
    mudline_of<3>({Point<3>(0., 0., 0.), Point<3>(4., 4., 4.)},
                  HalfSpace<3>(Point<3>(0., 3., 0.),
                               Tensor<1, 3>({-1., 1., 0.5})));
  EXPECT_NEAR(mudline.depth(Point<3>(1., 1., 2.)), 2., 1e-10);
  EXPECT_NEAR(mudline.depth(Point<3>(3., 1., 1.)), 3., 1e-10);
}



namespace
{
  /// Counts the questions of a search.
  struct CountingHalfSpace : HalfSpace<2>
  {
    CountingHalfSpace(const Tensor<1, 2> &normal, unsigned int &n_questions)
      : HalfSpace<2>(Point<2>(), normal)
      , n_questions(n_questions)
    {}

    bool
    may_cut_ball(const Point<2> &x, const double radius) const override
    {
      ++n_questions;
      return HalfSpace<2>::may_cut_ball(x, radius);
    }

    unsigned int &n_questions;
  };
} // namespace



// Steps do not begin with the height of the mesh each time.
TEST(Mudline, IsFoundByFewQuestions)
{
  unsigned int n_questions = 0;
  const auto   mudline =
    mudline_of<2>({Point<2>(-100., -100.), Point<2>(100., 900.)},
                  CountingHalfSpace(Tensor<1, 2>({-1., 1.}), n_questions));
  EXPECT_NEAR(mudline.depth(Point<2>(10., -20.)), 30., 1e-9);
  EXPECT_LT(n_questions, 50u);
}
