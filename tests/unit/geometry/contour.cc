// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/clip_simplex.h>
#include <talus/geometry/contour.h>

#include <gtest/gtest.h>

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double size = 0.1;

  template <int dim>
  std::vector<SurfaceElement<dim>>
  contour_of(const Shape<dim> &shape, const Box<dim> &box)
  {
    return contour<dim>(
      box,
      shape.bounding_box(),
      [&](const Point<dim> &x) { return shape.signed_distance(x); },
      size);
  }



  template <int dim>
  Tensor<1, dim>
  area_vector(const SurfaceElement<dim> &element)
  {
    return talus::vector_area<dim>(Facet<dim>(element.begin(), element.end()));
  }



  template <int dim>
  double
  area(const std::vector<SurfaceElement<dim>> &elements)
  {
    double result = 0;
    for (const SurfaceElement<dim> &element : elements)
      result += area_vector<dim>(element).norm();
    return result;
  }



  /// Corners on the surface, normals out of it, no corner missing.
  template <int dim>
  void
  expect_on_surface(const Shape<dim>                       &shape,
                    const std::vector<SurfaceElement<dim>> &elements)
  {
    for (const SurfaceElement<dim> &element : elements)
      {
        for (const Point<dim> &corner : element)
          EXPECT_LT(std::abs(shape.signed_distance(corner)), 0.02 * size);
        EXPECT_GT(area_vector<dim>(element) * shape.normal(element[0]), 0.);
      }
  }
} // namespace



TEST(Contour, OfAPlaneHasFewElements)
{
  const Point<2>     normal(1, 3);
  const HalfSpace<2> plane(Point<2>(1, 2), normal);
  const auto elements = contour_of<2>(plane, {Point<2>(-3, 0), Point<2>(7, 5)});
  expect_on_surface<2>(plane, elements);
  // From (-3, 10/3) to (7, 0).
  EXPECT_NEAR(area<2>(elements), std::hypot(10, 10. / 3), 1e-12);
  EXPECT_LT(elements.size(), 50u);
}



TEST(Contour, OfADiscAndABall)
{
  const Ball<2> disc(Point<2>(0.03, 1.01), 0.7);
  const auto    line = contour_of<2>(disc, {Point<2>(-2, -1), Point<2>(2, 3)});
  expect_on_surface<2>(disc, line);
  EXPECT_NEAR(area<2>(line), 2 * M_PI * 0.7, 2 * M_PI * 0.02 * size);

  const Ball<3> ball(Point<3>(0.03, 1.01, 0.02), 0.7);
  const auto    surface =
    contour_of<3>(ball, {Point<3>(-2, -1, -1), Point<3>(2, 3, 1)});
  expect_on_surface<3>(ball, surface);
  EXPECT_NEAR(area<3>(surface), 4 * M_PI * 0.49, 8 * M_PI * 0.7 * 0.02 * size);
}



// A small body in a large, otherwise empty mesh is found, and only the part in
// the mesh is drawn.
TEST(Contour, OfABodyThatIsSmallInTheMesh)
{
  const Ball<2> disc(Point<2>(76.3, 0.), 0.2);
  const auto line = contour_of<2>(disc, {Point<2>(-100, 0), Point<2>(200, 10)});
  expect_on_surface<2>(disc, line);
  EXPECT_NEAR(area<2>(line), M_PI * 0.2, 1e-2);
}



TEST(Contour, CutsOffCornersByHalfOfTheSize)
{
  const BoxRegion<2> box({Point<2>(0.013, 0.017), Point<2>(2, 1)});
  const auto line = contour_of<2>(box, {Point<2>(-1, -1), Point<2>(3, 3)});
  EXPECT_NEAR(area<2>(line), 2 * (1.987 + 0.983), 4 * 2 * 0.5 * size);
  for (const auto &element : line)
    for (const Point<2> &corner : element)
      EXPECT_LT(std::abs(box.signed_distance(corner)), 0.5 * size);
}



// On the face of the mesh, once: a seabed at its bottom.
TEST(Contour, OnTheFaceOfTheMesh)
{
  const HalfSpace<3> ground(Point<3>(), Point<3>(0, 1, 0));
  const auto         surface =
    contour_of<3>(ground, {Point<3>(0, 0, 0), Point<3>(4, 2, 3)});
  EXPECT_NEAR(area<3>(surface), 12., 1e-12);
}
