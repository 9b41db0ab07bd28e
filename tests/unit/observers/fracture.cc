// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/fracture.h>

#include <gtest/gtest.h>

#include "observers_setup.h"
#include "obstacles_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;

  class Fracture : public ObserversTest
  {};



  /// On the bottom of the mesh.
  template <int dim>
  FractureCounts
  count(const Scene<dim> &s)
  {
    return count_fractures(s.points, s.grid, Ground<dim>(s.grid.domain()));
  }



  template <int dim>
  FractureCounts
  count(const Scene<dim> &s, const Obstacles<dim> &obstacles)
  {
    return count_fractures(s.points,
                           s.grid,
                           Ground<dim>(s.grid.domain(), &obstacles));
  }



  TEST_F(Fracture, SolidBlock)
  {
    Scene<2> s("0, 0", "8, 4");
    for (unsigned int i = 2; i < 5; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        s.add({i + 0.25, j + 0.5}), s.add({i + 0.75, j + 0.5});
    const FractureCounts counts = count(s);
    EXPECT_EQ(counts.occupied_cells, 6u);
    EXPECT_EQ(counts.empty_interior_cells, 0u);
    EXPECT_EQ(counts.empty_columns, 0u);
    EXPECT_EQ(counts.connected_bodies, 1u);
    EXPECT_EQ(counts.cells_with_one_point, 0u);
  }



  TEST_F(Fracture, HolesGapsAndLonelyPoints)
  {
    // . . . . . . . .
    // # . . . . . . .
    // . # . . . . . .
    // # . . # . . # .
    Scene<2> s("0, 0", "8, 4");
    for (const auto &x : std::vector<Point<2>>{
           {0.5, 0.5}, {0.5, 2.5}, {1.5, 1.5}, {3.5, 0.5}, {6.5, 0.2}})
      s.add(x);
    s.add({6.5, 0.8});
    const FractureCounts counts = count(s);
    EXPECT_EQ(counts.occupied_cells, 5u);
    // Below the diagonal neighbour too: down to the bottom face.
    EXPECT_EQ(counts.empty_interior_cells, 2u);
    EXPECT_EQ(counts.empty_columns, 3u);
    // The three on the left touch across corners.
    EXPECT_EQ(counts.connected_bodies, 3u);
    EXPECT_EQ(counts.cells_with_one_point, 4u);
  }



  // A pillar with an arm, and below the arm something that hangs beside them:
  // under the arm, which the pillar carries, soil is missing.
  TEST_F(Fracture, BelowSoilThatHangsNoneIsMissing)
  {
    // . . . . . . . .
    // # # # . . # # .
    // # . . . . # . .
    // # . . . . # # .
    // # . . . . . . .
    Scene<2> s("0, 0", "8, 5");
    for (const auto &x : std::vector<Point<2>>{
           {5.5, 1.5}, {6.5, 1.5}, {5.5, 2.5}, {5.5, 3.5}, {6.5, 3.5}})
      s.add(x);
    EXPECT_EQ(count(s).empty_interior_cells, 1u);
    for (unsigned int j = 0; j < 4; ++j)
      s.add({0.5, j + 0.5});
    s.add({1.5, 3.5});
    s.add({2.5, 3.5});
    EXPECT_EQ(count(s).empty_interior_cells, 1u + 6u);
    EXPECT_EQ(count(s).connected_bodies, 2u);
    // Now it stands on the bottom, too.
    s.add({5.5, 0.5});
    EXPECT_EQ(count(s).empty_interior_cells, 2u + 6u);
  }



  TEST_F(Fracture, LastCellOfAColumnIsNoNeighborOfTheNextColumnsFirst)
  {
    Scene<2> s("0, 0", "8, 4");
    s.add({0.5, 3.5});
    s.add({1.5, 0.5});
    EXPECT_EQ(count(s).connected_bodies, 2u);
  }



  TEST_F(Fracture, PointsOutsideTheMeshCountToTheBoundaryCell)
  {
    Scene<2> s("-4, -1", "4, 3");
    s.add({0.5, -1.4});
    s.add({4.3, 3.2});
    const FractureCounts counts = count(s);
    EXPECT_EQ(counts.occupied_cells, 2u);
    EXPECT_EQ(counts.empty_interior_cells, 0u); // none below what hangs
    EXPECT_EQ(counts.empty_columns, 2u);
    // In the cell it was counted to, it joins the others.
    s.add({0.5, -0.9});
    EXPECT_EQ(count(s).occupied_cells, 2u);
  }



  TEST_F(Fracture, BodiesThatMeetLateAreOne)
  {
    // A U lying on its side and a comb: union-find must join what the sweep
    // first takes for separate bodies.
    Scene<2> s("0, 0", "16, 8");
    for (unsigned int j = 0; j < 8; j += 2)
      for (unsigned int i = 0; i < 9; ++i)
        s.add({i + 0.5, j + 0.5});
    EXPECT_EQ(count(s).connected_bodies, 4u);
    for (unsigned int j = 0; j < 8; ++j)
      s.add({9.5, j + 0.5});
    EXPECT_EQ(count(s).connected_bodies, 1u);
    EXPECT_EQ(count(s).empty_interior_cells, 27u);
  }



  TEST_F(Fracture, IndependentOfTheCellsOfTheMesh)
  {
    Scene<2> coarse("0, 0", "8, 4");
    for (const auto &x : std::vector<Point<2>>{
           {0.5, 0.5}, {0.5, 2.5}, {1.5, 1.5}, {3.5, 0.5}, {6.5, 0.2}})
      coarse.add(x);
    // Refined somewhere, the mesh still counts in cells of Grid/Cell size.
    auto &triangulation = coarse.grid.triangulation();
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->center().distance(Point<2>(7.5, 3.5)) < 0.1)
        cell->set_refine_flag();
    triangulation.execute_coarsening_and_refinement();
    coarse.grid.prepare();
    const FractureCounts counts = count(coarse);
    EXPECT_EQ(counts.occupied_cells, 5u);
    EXPECT_EQ(counts.connected_bodies, 3u); // across corners
    EXPECT_EQ(counts.empty_columns, 3u);    // 0, 1 | 3 | 6
    EXPECT_EQ(counts.empty_interior_cells, 2u);
  }



  // Down to the bed, whose surface is at y = 5.3 - 0.4 x: cells with their
  // centre below it are none of the soil's.
  TEST_F(Fracture, OnAnInclinedBed)
  {
    Scene<2>               s("0, 0", "8, 8");
    const WithObstacles<2> bed{
      {"bed", "Shape = half-plane|Point = 0, 5.3|Normal = 0.4, 1"}};
    // Two cells thick, that with the surface at most half filled.
    std::vector<unsigned int> lowest;
    for (unsigned int i = 0; i < 8; ++i)
      {
        lowest.push_back(std::lround(5.3 - 0.4 * (i + 0.5)));
        s.add({i + 0.5, lowest.back() + 1.5});
        if (i != 3 && i != 5)
          s.add({i + 0.5, lowest.back() + 0.9});
      }
    EXPECT_EQ(count(s, bed.obstacles).empty_interior_cells, 2u);
    EXPECT_EQ(count(s, bed.obstacles).connected_bodies, 1u);
    // To the bottom of the mesh nothing rests, so nothing would be missing.
    EXPECT_EQ(count(s).empty_interior_cells, 0u);
    s.add({3.5, lowest[3] + 0.9});
    s.add({5.5, lowest[5] + 0.9});
    EXPECT_EQ(count(s, bed.obstacles).empty_interior_cells, 0u);
  }



  // Soil that falls onto a bed, and has not come to it.
  TEST_F(Fracture, AboveABedNoneIsMissing)
  {
    Scene<2>               s("0, 0", "8, 8");
    const WithObstacles<2> bed{{"bed", "Shape = half-plane|Point = 0, 2"}};
    s.add({2.5, 4.5});
    s.add({3.5, 4.5});
    EXPECT_EQ(count(s, bed.obstacles).empty_interior_cells, 0u);
    s.add({3.5, 3.5});
    EXPECT_EQ(count(s, bed.obstacles).empty_interior_cells, 0u);
    s.add({3.5, 2.5});
    EXPECT_EQ(count(s, bed.obstacles).empty_interior_cells, 2u);
  }



  // # # # # #     The cells of a pipe (o) are not empty, nor are those between
  // # o o # #     it and the bed: the soil above lies on the pipe.
  // # o o . #
  // # . . # #
  TEST_F(Fracture, AroundAPipe)
  {
    Scene<2>               s("0, 0", "8, 8");
    const WithObstacles<2> pipe{
      {"pipe", "Shape = box|Lower corner = 1.1, 1.1|Upper corner = 2.9, 2.9"}};
    for (unsigned int i = 0; i < 5; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        if (j == 3 || i == 0 || i == 4 || (i == 3 && j != 1))
          s.add({i + 0.5, j + 0.5});
    EXPECT_EQ(count(s, pipe.obstacles).empty_interior_cells, 1u);
    EXPECT_EQ(count(s, pipe.obstacles).connected_bodies, 1u);
    EXPECT_EQ(count(s).empty_interior_cells, 7u);
  }



  TEST_F(Fracture, ThreeDimensions)
  {
    Scene<3> s("0, 0, 0", "8, 4, 4");
    s.add({0.5, 0.5, 0.5});
    s.add({1.5, 1.5, 1.5}); // touches the first across a corner
    s.add({1.5, 2.5, 1.5});
    s.add({1.5, 0.5, 3.5}); // not the one beside it: two cells away in z
    s.add({4.5, 3.5, 0.5});
    s.add({4.6, 3.5, 0.5});
    const FractureCounts counts = count(s);
    EXPECT_EQ(counts.occupied_cells, 5u);
    EXPECT_EQ(counts.empty_interior_cells, 1u); // none below what hangs
    EXPECT_EQ(counts.empty_columns, 2u);
    EXPECT_EQ(counts.connected_bodies, 3u);
    EXPECT_EQ(counts.cells_with_one_point, 4u);
  }
} // namespace
