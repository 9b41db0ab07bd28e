// SPDX-License-Identifier: LGPL-2.1-or-later
#include "ranks_setup.h"

#include <talus/contact/point_confinement.h>

namespace
{
  /// Soil over obstacles, whose points are moved by hand.
  struct SoilOnObstacles : Core<2>
  {
    SoilOnObstacles(const std::vector<std::string> &names,
                    const std::string              &text)
      : Core<2>(slab<2>(), {}, MPI_COMM_SELF)
      , obstacles(names)
    {
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Obstacles", text));
      dealii::ParameterAcceptor::parse_all_parameters();
      obstacles.prepare(Constants());
      facets.prepare(grid, obstacles);
      time_step = 0.1;
    }

    /// Where a point at @p from ends that a step would move by @p by, m.
    Point<2>
    moved(const Point<2> &from, const Vector &by)
    {
      const unsigned int p = add(from, Point<2>(0.4, 0.4));
      set(points.velocity, p, by / time_step);
      sort();
      // In front of obstacles that move, as in a step.
      PointConfinement<2> confinement(obstacles, facets);
      workspace.reinit(0, points.size());
      confinement.note(*this, {0, 1, 0, 1});
      set(points.position, 0, from + by);
      confinement.confine(*this);
      is_noted = !workspace.points_out_of_cell().empty();
      return Point<2>(get(points.position, 0));
    }

    Obstacles<2> obstacles;
    Facets<2>    facets;
    bool         is_noted = false; ///< for another look at its cell
  };

  /// From a place on a surface to the centre of a box of 0.4 m that touches it.
  Tensor<1, 2>
  to_centre(const Tensor<1, 2> &normal)
  {
    return 0.2 * (std::abs(normal[0]) + std::abs(normal[1])) * normal;
  }

  const std::string inclined_bed =
    in_section("bed",
               "set Shape = half-plane\nset Point = 0, 1.2\n"
               "set Normal = -0.28, 0.96");

  void
  expect_moved_to(const Point<2> &found, const Point<2> &expected)
  {
    EXPECT_LT(found.distance(expected), 1e-14) << found << " | " << expected;
  }
} // namespace



// By hand, with the normal (-7, 24)/25 and the tangent (24, 7)/25: what leads
// into the obstacle is left out from its surface on, the rest is not.
TEST(PointConfinement, StopsAtTheSurface)
{
  const Tensor<1, 2> normal({-0.28, 0.96}), tangent({0.96, 0.28});
  const Point<2> foot = Point<2>(0., 1.2) + 2.2 * tangent + to_centre(normal);
  {
    SoilOnObstacles soil({"bed"}, inclined_bed);
    expect_moved_to(soil.moved(foot + 0.03 * normal,
                               0.05 * tangent - 0.08 * normal),
                    foot + 0.05 * tangent);
    EXPECT_TRUE(soil.is_noted);
  }
  {
    SoilOnObstacles soil({"bed"}, inclined_bed);
    expect_moved_to(soil.moved(foot + 0.03 * normal, -0.02 * normal),
                    foot + 0.01 * normal);
    EXPECT_FALSE(soil.is_noted);
  }
}



TEST(PointConfinement, WhatIsInsideGoesNoDeeper)
{
  const Tensor<1, 2> normal({-0.28, 0.96}), tangent({0.96, 0.28});
  const Point<2>     inside =
    Point<2>(0., 1.2) + 2.2 * tangent - 0.04 * normal + to_centre(normal);
  {
    SoilOnObstacles soil({"bed"}, inclined_bed);
    expect_moved_to(soil.moved(inside, 0.02 * tangent - 0.01 * normal),
                    inside + 0.02 * tangent);
  }
  {
    SoilOnObstacles soil({"bed"}, inclined_bed);
    expect_moved_to(soil.moved(inside, 0.01 * normal), inside + 0.01 * normal);
  }
}



// The obstacle rises by 0.02 m in the step and carries what lies on it.
TEST(PointConfinement, ObstacleThatMoves)
{
  SoilOnObstacles soil({"lift"},
                       in_section("lift",
                                  "set Shape = half-plane\nset Point = 0, 1.3\n"
                                  "set Normal = 0, 1\nset Velocity = 0; 0.2"));
  soil.obstacles.advance(0., soil.time_step);
  soil.facets.update(soil.grid, soil.obstacles);
  expect_moved_to(soil.moved({2.2, 1.5}, Point<2>(0.01, 0.)), {2.21, 1.52});
}



// Where a wall meets the bed, the centroid of the bed in that cell lies inside
// of the wall: it bears nothing, but points must not slip through it.
TEST(PointConfinement, CornerOfTwoObstacles)
{
  SoilOnObstacles soil(
    {"bed", "wall"},
    in_section("bed",
               "set Shape = half-plane\nset Point = 0, 1.2\n"
               "set Normal = 0, 1") +
      in_section("wall",
                 "set Shape = half-plane\nset Point = 2.3, 0\n"
                 "set Normal = -1, 0"));
  expect_moved_to(soil.moved({2.06, 1.43}, Point<2>(0.06, -0.05)), {2.1, 1.4});
}



// A wall on faces of the mesh.
TEST(PointConfinement, WallOnTheMesh)
{
  for (const double gap : {0.03, 0.})
    {
      SoilOnObstacles soil({"wall"},
                           in_section("wall",
                                      "set Shape = half-plane\n"
                                      "set Point = 3, 0\nset Normal = -1, 0"));
      expect_moved_to(soil.moved({2.8 - gap, 1.3}, Point<2>(0.05, 0.02)),
                      {2.8, 1.32});
    }
}
