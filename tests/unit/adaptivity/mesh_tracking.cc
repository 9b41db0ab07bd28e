// SPDX-License-Identifier: LGPL-2.1-or-later
// The suite works on any number of ranks; ctest runs it on 1 and 3.
#include "mesh_tracking_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(MeshTracking, 3);

namespace
{
  /// Replace the points by some around @p centre.
  template <int dim>
  void
  put_cluster(Tracked<dim> &core, const double x)
  {
    core.points.clear();
    core.random.seed(1);
    for (unsigned int i = 0; i < 30; ++i)
      {
        Point<dim> at = Point<dim>() + core.vector(0., 6.);
        at[0] += x;
        core.put(at);
      }
    core.relocation.rebuild(core.points, core.grid);
  }



  template <int dim>
  double
  largest_cell(const Grid<dim> &grid)
  {
    double size = 0;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      size = std::max(size, grid.cells()[c].size);
    return MPI::max(size, grid.communicator());
  }



  /// On many ranks siblings are joined once they are on one of them: give the
  /// cells to others and look again, until nothing changes.
  template <int dim>
  void
  follow_to_the_end(Tracked<dim> &core, const double x)
  {
    for (unsigned int i = 0; core.follow(); ++i)
      {
        ASSERT_LT(i, 10u);
        core.points.clear();
        scramble(core, i);
        put_cluster(core, x);
      }
  }



  template <int dim>
  void
  expect_mesh_that_follows()
  {
    const std::set<unsigned long> fresh = [&]() {
      Tracked<dim> core(long_mesh<dim>());
      core.begin({box<dim>({14., 0., 0.}, {20., 6., 6.})});
      put_cluster(core, 14.);
      follow_to_the_end(core, 14.);
      expect_mesh_around_soil(core);
      return all_cells(core.grid);
    }();
    Tracked<dim> core(long_mesh<dim>());
    core.begin({box<dim>({0., 0., 0.}, {6., 6., 6.})});
    // Never farther than into the margin: soil is in cells of size h.
    for (const double x :
         dim == 2 ? std::vector<double>{3.5, 8., 12., 16.5, 20., 17., 14.}
                  : std::vector<double>{4.5, 9., 14.})
      {
        SCOPED_TRACE(text(dim, "-D, soil at ", x));
        put_cluster(core, x);
        follow_to_the_end(core, x);
        expect_mesh_around_soil(core);
        // In the middle of the mesh there is no room for whole trees.
        EXPECT_EQ(largest_cell(core.grid), x == 20. ? 8. : 16.);
      }
    EXPECT_EQ(all_cells(core.grid), fresh);
  }



  TEST(MeshTracking, FollowsTheSoilAndForgetsItsWay)
  {
    expect_mesh_that_follows<2>();
    expect_mesh_that_follows<3>();
  }



  /// Bodies to be ask for the same cells as points that fill them.
  TEST(MeshTracking, StartsAroundTheBodies)
  {
    Tracked<2>   core(long_mesh<2>());
    const Box<2> soil{{20.2, 3.1}, {31.7, 7.3}};
    core.begin({soil});
    for (double x = 20.25; x < 31.7; x += 0.5)
      for (double y = 3.25; y < 7.3; y += 0.5)
        core.put(Point<2>(x, y));
    core.sort();
    expect_mesh_around_soil(core);
    EXPECT_FALSE(core.follow());
  }



  /// Small cells from x = 0 to 40 m; soil has left those beyond @p end.
  /// Return whether the mesh is coarsened without need.
  bool
  is_coarsened(const double end)
  {
    Tracked<2> core(long_mesh<2>());
    core.begin({Box<2>{{0.2, 0.1}, {39.8, 7.8}}});
    for (double x = 0.25; x < end; x += 0.5)
      for (double y = 0.25; y < 7.8; y += 0.5)
        core.put(Point<2>(x, y));
    core.relocation.rebuild(core.points, core.grid);
    return core.follow(/*is_urgent=*/false);
  }



  // A column of blocks is 4 m long: the last column is less than a tenth of the
  // small cells, two columns are more.
  TEST(MeshTracking, CoarsensIfATenthIsNotNeeded)
  {
    EXPECT_FALSE(is_coarsened(39.9));
    EXPECT_FALSE(is_coarsened(36.9));
    EXPECT_TRUE(is_coarsened(27.9));
  }



  // -------------------------------------------------------------- is it urgent

  /// Numbers over all ranks of the corners of the cells larger than h, and of
  /// those that touch one.
  template <int dim>
  std::set<unsigned long>
  nodes_of_larger_cells(const Grid<dim> &grid)
  {
    std::vector<Box<dim>> larger;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      if (grid.cells()[c].size > 1.5 * grid.cell_size())
        larger.push_back(grid.cells()[c].box());
    std::vector<std::array<double, 2 * dim>> own_ends;
    for (const Box<dim> &box : larger)
      {
        std::array<double, 2 * dim> ends;
        for (unsigned int d = 0; d < dim; ++d)
          {
            ends[d]       = box.lower[d];
            ends[dim + d] = box.upper[d];
          }
        own_ends.push_back(ends);
      }
    const auto all_ends       = MPI::all_gather(grid.communicator(), own_ends);
    const auto touches_larger = [&](const Cell<dim> &cell) {
      for (const auto &of_rank : all_ends)
        for (const auto &ends : of_rank)
          {
            bool touches = true;
            for (unsigned int d = 0; d < dim; ++d)
              touches = touches && ends[d] < cell.box().upper[d] + 1e-6 &&
                        ends[dim + d] > cell.lower[d] - 1e-6;
            if (touches)
              return true;
          }
      return false;
    };
    std::set<unsigned long> own, all;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      if (touches_larger(grid.cells()[c])) // or is one
        for (const unsigned int node : grid.cells()[c].nodes())
          own.insert(number_of_node(grid, node));
    for (const auto &part : MPI::all_gather(grid.communicator(), own))
      all.insert(part.begin(), part.end());
    return all;
  }



  /// Numbers over all ranks of the nodes that the largest boxes in a cell
  /// touch, hanging nodes replaced by their masters.
  template <int dim>
  std::set<unsigned long>
  nodes_in_reach(
    const Grid<dim>                                         &grid,
    const unsigned int                                       c,
    const std::map<unsigned int, std::vector<unsigned int>> &masters)
  {
    const Cell<dim>             &cell = grid.cells()[c];
    std::set<unsigned long>      nodes;
    std::vector<NodeWeight<dim>> weights;
    Tensor<1, dim>               half;
    for (unsigned int d = 0; d < dim; ++d)
      half[d] = 0.5 * cell.size;
    for (unsigned int corner = 0; corner < power(2, dim); ++corner)
      {
        Point<dim> centre = cell.lower;
        for (unsigned int d = 0; d < dim; ++d)
          centre[d] += ((corner >> d) & 1) * cell.size;
        general_weights(grid, c, centre, half, weights);
        for (const auto &weight : weights)
          if (weight.value > 1e-12)
            {
              if (const auto it = masters.find(weight.node);
                  it != masters.end())
                for (const unsigned int master : it->second)
                  nodes.insert(number_of_node(grid, master));
              else
                nodes.insert(number_of_node(grid, weight.node));
            }
      }
    return nodes;
  }



  template <int dim>
  void
  expect_urgency(Tracked<dim> &core)
  {
    const auto                                       &grid = core.grid;
    std::map<unsigned int, std::vector<unsigned int>> masters;
    for (const auto &hanging : grid.hanging_nodes())
      for (const auto &master : hanging.masters)
        masters[hanging.node].push_back(master.first);
    const auto   larger   = nodes_of_larger_cells(grid);
    unsigned int n_urgent = 0, n_calm = 0;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        bool expected = false;
        for (const unsigned long node : nodes_in_reach(grid, c, masters))
          expected = expected || larger.count(node) > 0;
        // In a cell beside smaller ones it may be urgent a cell too early.
        const bool is_urgent = core.tracking.is_urgent(grid, {c});
        EXPECT_TRUE(grid.cells()[c].uniform ? is_urgent == expected
                                            : is_urgent || !expected)
          << grid.cells()[c].lower << ", " << grid.cells()[c].size;
        ++(expected ? n_urgent : n_calm);
      }
    EXPECT_GT(MPI::sum(n_urgent, MPI_COMM_WORLD), 0u);
    EXPECT_GT(MPI::sum(n_calm, MPI_COMM_WORLD), 0u);
    EXPECT_FALSE(core.tracking.is_urgent(grid, {}));
  }



  template <int dim>
  void
  expect_urgency()
  {
    for (const std::string boxes :
         {"",
          dim == 2 ? "set Refinement boxes = 18, 0; 24, 3; 1 | 22, 2; 27, 5; 2"
                   : "set Refinement boxes = 18, 0, 0; 24, 3, 3; 1"})
      for (unsigned int seed = 1; seed < (dim == 2 ? 4 : 2); ++seed)
        {
          SCOPED_TRACE(text(dim, "-D, ", boxes, ", shares ", seed));
          Tracked<dim> core(long_mesh<dim>(boxes));
          core.begin({box<dim>({20., 0., 0.}, {26., 6., 6.})});
          scramble(core, seed);
          expect_urgency(core);
        }
  }



  TEST(MeshTracking, IsUrgentWhereALargerCellIsInReach)
  {
    expect_urgency<2>();
    expect_urgency<3>();
  }
} // namespace
