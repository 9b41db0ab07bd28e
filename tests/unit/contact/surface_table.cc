// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/surface_table.h>
#include <talus/geometry/analytic_shapes.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  Box<dim>
  unit_box()
  {
    Box<dim> box;
    for (unsigned int d = 0; d < dim; ++d)
      box.upper[d] = 1.;
    return box;
  }



  /// Places of a lattice in the unit box and an eighth of its length around.
  template <int dim>
  std::vector<Point<dim>>
  places()
  {
    constexpr unsigned int  n = 6;
    std::vector<Point<dim>> result(std::pow(n, dim));
    for (unsigned int i = 0; i < result.size(); ++i)
      for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n)
        result[i][d] = -0.125 + 0.25 * (rest % n);
    return result;
  }



  /// Largest errors of distance, m, and normal at places().
  template <int dim>
  std::pair<double, double>
  errors(const SurfaceTable<dim> &table, const Shape<dim> &shape)
  {
    std::pair<double, double> result(0., 0.);
    for (const Point<dim> &x : places<dim>())
      {
        EXPECT_TRUE(table.reaches(x));
        const auto [distance, normal] = table.distance_and_normal(x);
        EXPECT_NEAR(normal.norm(), 1., 1e-14);
        result.first =
          std::max(result.first, std::abs(distance - shape.signed_distance(x)));
        result.second =
          std::max(result.second, (normal - shape.normal(x)).norm());
      }
    return result;
  }



  template <int dim>
  void
  expect_exact_plane()
  {
    Point<dim>     foot;
    Tensor<1, dim> normal;
    for (unsigned int d = 0; d < dim; ++d)
      {
        foot[d]   = 0.3 + 0.1 * d;
        normal[d] = 1. + d * d;
      }
    const HalfSpace<dim>    plane(foot, normal);
    const SurfaceTable<dim> table(plane, unit_box<dim>());
    EXPECT_TRUE(table.is_accurate());
    const auto [distance, angle] = errors<dim>(table, plane);
    EXPECT_LT(distance, 1e-14);
    EXPECT_LT(angle, 1e-14);
  }



  /// Errors for a ball whose surface passes through the box, by radius.
  template <int dim>
  std::pair<double, double>
  errors_of_ball(const double radius)
  {
    Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = 0.5;
    centre[1] -= radius;
    const Ball<dim>         ball(centre, radius);
    const SurfaceTable<dim> table(ball, unit_box<dim>());
    EXPECT_TRUE(table.is_accurate()) << radius;
    return errors<dim>(table, ball);
  }
} // namespace



TEST(SurfaceTable, PlanesAreExact)
{
  expect_exact_plane<2>();
  expect_exact_plane<3>();
}



// Quadratic interpolation: a ball of twice the radius, seen from the box, has a
// third derivative four times smaller.
TEST(SurfaceTable, BallsToThirdOrder)
{
  const auto near_2d = errors_of_ball<2>(10.), far_2d = errors_of_ball<2>(20.);
  EXPECT_LT(near_2d.first, 1e-3);
  EXPECT_LT(near_2d.second, 7e-3);
  EXPECT_LT(far_2d.first, near_2d.first / 3.5);
  const auto near_3d = errors_of_ball<3>(10.), far_3d = errors_of_ball<3>(20.);
  EXPECT_LT(near_3d.first, 1e-3);
  EXPECT_LT(near_3d.second, 7e-3);
  EXPECT_LT(far_3d.first, near_3d.first / 3.5);
}



// The edge of a box, and a ball smaller than the box of the table.
TEST(SurfaceTable, EdgesAreNotTabulated)
{
  const Point<3>     corner(0.4, 0.6, 0.5);
  const BoxRegion<3> block({Point<3>(-9., -9., -9.), corner});
  EXPECT_FALSE(SurfaceTable<3>(block, unit_box<3>()).is_accurate());
  const Ball<2> small(Point<2>(0.45, 0.55), 0.2);
  EXPECT_FALSE(SurfaceTable<2>(small, unit_box<2>()).is_accurate());
}



TEST(SurfaceTable, ReachesAQuarterOfTheBoxFarther)
{
  const HalfSpace<2>    plane(Point<2>(), Point<2>(0., 1.));
  const SurfaceTable<2> table(plane, unit_box<2>());
  EXPECT_TRUE(table.reaches(Point<2>(-0.24, 1.24)));
  EXPECT_FALSE(table.reaches(Point<2>(-0.26, 0.5)));
  EXPECT_FALSE(table.reaches(Point<2>(0.5, 1.26)));
  EXPECT_FALSE(table.reaches(Point<2>(0.5, std::nan(""))));
}
