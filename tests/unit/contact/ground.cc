// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/ground.h>

#include <gtest/gtest.h>

#include <iomanip>

#include "core_setup.h"
#include "obstacles_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  const Box<2> mesh_2d{Point<2>(-10, -4), Point<2>(30, 8)};
  const Box<3> mesh_3d{Point<3>(-10, -4, 0), Point<3>(30, 8, 6)};

  const WithObstacles<2>::Section
    small_pipe("pipe", "Shape = ball|Centre = 5, -3.5|Radius = 0.5");

  /// Parameters of the objects of one test alone.
  struct GroundTest : testing::Test
  {
    FreshParameters fresh;
  };



  template <int dim>
  void
  expect_level(const Ground<dim> &ground, const Point<dim> &x, const double y)
  {
    EXPECT_NEAR(ground.elevation(x), y, 1e-10);
    EXPECT_LT((ground.layer_normal(x) - Point<dim>::unit_vector(1)).norm(),
              1e-12);
  }
} // namespace



TEST_F(GroundTest, WithoutObstacles)
{
  const Ground<2> ground(mesh_2d);
  EXPECT_TRUE(ground.is_bottom_face());
  EXPECT_TRUE(ground.is_open(Point<2>(0, -3)));
  EXPECT_FALSE(ground.encloses(Point<2>(0, -3)));
  EXPECT_TRUE(ground.encloses(Point<2>(0, -4)));
  expect_level(ground, Point<2>(1, 2), -4.);
  const WithObstacles<2> none{};
  EXPECT_TRUE(Ground<2>(mesh_2d, &none.obstacles).is_bottom_face());
}



// From above and from within, on slopes of any steepness, also where the bed
// goes below the mesh.
TEST_F(GroundTest, InclinedBed)
{
  for (const double degrees : {0., 5., 30., 44.})
    {
      dealii::ParameterAcceptor::clear();
      const double           slope = std::tan(degrees * M_PI / 180);
      const WithObstacles<3> bed{
        {"bed",
         text("Shape = half-plane|Point = 0, 1, 0|Normal = ",
              std::setprecision(17),
              slope,
              ", 1, 0")}};
      const Ground<3> ground(mesh_3d, &bed.obstacles);
      Tensor<1, 3>    normal = Point<3>(slope, 1, 0);
      normal /= normal.norm();
      for (const double x : {-3., 0.17, 4., 29.})
        for (const double y : {-2., 0.9, 1.3, 7.})
          {
            const Point<3> at(x, y, 2.5);
            const double   surface = 1 - slope * x;
            EXPECT_NEAR(ground.elevation(at),
                        surface < -4. ? -4. : surface,
                        1e-10);
            EXPECT_EQ(ground.is_open(at), y > surface);
            EXPECT_EQ(ground.encloses(at), y <= surface);
            if (surface > -4.)
              {
                EXPECT_LT((ground.layer_normal(at) - normal).norm(), 1e-12);
              }
          }
    }
}



// Soil over a pipe is in the same layers as soil beside it.
TEST_F(GroundTest, APipeIsNone)
{
  const WithObstacles<2> obstacles{small_pipe};
  const Ground<2>        ground(mesh_2d, &obstacles.obstacles);
  EXPECT_FALSE(ground.is_bottom_face());
  EXPECT_FALSE(ground.is_open(Point<2>(5, -3.5)));
  EXPECT_FALSE(ground.encloses(Point<2>(5, -3.5)));
  expect_level(ground, Point<2>(5, -2), -4.);
  expect_level(ground, Point<2>(5, -3.5), -4.);
}



TEST_F(GroundTest, APipeOnABed)
{
  const WithObstacles<2> obstacles{small_pipe,
                                   {"bed",
                                    "Shape = half-plane|Point = 0, -3.8"}};
  const Ground<2>        ground(mesh_2d, &obstacles.obstacles);
  expect_level(ground, Point<2>(5, -2), -3.8);
  EXPECT_TRUE(ground.is_open(Point<2>(4.4, -3.79)));
  EXPECT_FALSE(ground.is_open(Point<2>(4.4, -3.81)));
}



// A cylinder without ends crosses the mesh along z only.
TEST_F(GroundTest, APipeAcrossTheMeshIsNone)
{
  const WithObstacles<3> obstacles{
    {"pipe", "Shape = cylinder|Centre = 5, -2, 0|Radius = 0.5"}};
  const Ground<3> ground(mesh_3d, &obstacles.obstacles);
  expect_level(ground, Point<3>(5, 0, 3), -4.);
}



// A seabed that does not go below the mesh, but along it: the soil lies on it,
// or under it.
TEST_F(GroundTest, APlateAlongTheMesh)
{
  const WithObstacles<2> obstacles{
    {"plate", "Shape = box|Lower corner = -20, 0|Upper corner = 40, 1"}};
  const Ground<2> ground(mesh_2d, &obstacles.obstacles);
  expect_level(ground, Point<2>(5, 3), 1.);
  expect_level(ground, Point<2>(5, 0.3), 1.);
  expect_level(ground, Point<2>(5, -1), -4.);
}



// Breaks and flats, and a step between them.
TEST_F(GroundTest, SeabedOfStraightEdges)
{
  const WithObstacles<2> obstacles{
    {"bed",
     "Shape = polygon|Open = true|Vertices = -20,3; 0,3; 5,0; 10,0; 10,-2; "
     "40,-2"}};
  const Ground<2> ground(mesh_2d, &obstacles.obstacles);
  expect_level(ground, Point<2>(-5, 4), 3.);
  expect_level(ground, Point<2>(7, 6), 0.);
  expect_level(ground, Point<2>(20, 0), -2.);
  EXPECT_NEAR(ground.elevation(Point<2>(2, 6)), 3 - 0.6 * 2, 1e-10);
  Tensor<1, 2> normal = Point<2>(3, 5);
  normal /= normal.norm();
  EXPECT_LT((ground.layer_normal(Point<2>(2, 6)) - normal).norm(), 1e-12);
  // A thousandth beside the step.
  EXPECT_NEAR(ground.elevation(Point<2>(10.001, -1)), -2., 1e-10);
}



// In a container soil lies in layers along its floor, also over a wall that
// leans outwards; the wall is still what is below it.
TEST_F(GroundTest, WallsAreNotWhatLayersFollow)
{
  const WithObstacles<2> obstacles{
    {"floor", "Shape = half-plane|Point = 0, -2|Normal = 0.1, 1"},
    {"wall", "Shape = half-plane|Point = 0, 0|Normal = 1, 0.1"}};
  const Ground<2> ground(mesh_2d, &obstacles.obstacles);
  const Point<2>  beside(-0.2, 3);
  EXPECT_NEAR(ground.elevation(beside), 2., 1e-10);
  Tensor<1, 2> normal = Point<2>(0.1, 1);
  normal /= normal.norm();
  EXPECT_LT((ground.layer_normal(beside) - normal).norm(), 1e-12);
}
