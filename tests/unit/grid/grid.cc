// SPDX-License-Identifier: LGPL-2.1-or-later
#include <limits>
#include <set>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;

  // -------------------------------------------------------------- the mesh

  template <int dim>
  void
  expect_exact_cells(const std::string &parameters, const double size)
  {
    const Core<dim> core(parameters);
    const auto     &grid = core.grid;
    double          n    = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n *= std::round(grid.domain().length(d) / size);
    EXPECT_EQ(grid.cells().size(), n);
    EXPECT_EQ(grid.n_owned_cells(), n);
    EXPECT_NEAR(grid.finest_size(), size, 1e-15);
    for (const auto &cell : grid.dof_handler().active_cell_iterators())
      {
        const Cell<dim> &c = grid.cells()[grid.index_of(cell)];
        EXPECT_NEAR(c.size, size, 1e-15);
        for (unsigned int d = 0; d < dim; ++d)
          {
            EXPECT_NEAR(c.lower[d], cell->vertex(0)[d], 1e-13);
            EXPECT_NEAR(cell->extent_in_direction(d), size, 1e-13);
          }
      }
  }



  TEST(Grid, CellsAreExact)
  {
    expect_exact_cells<2>(mesh("-1.3, 0.7", "1.3, 2.3", "0.2"), 0.2);
    expect_exact_cells<3>(mesh("-0.1, 0, 0.3", "0.5, 0.4, 0.5", "0.1"), 0.1);
  }



  template <int dim>
  struct Layout : MeshLayout<dim>
  {
    using MeshLayout<dim>::max_n_cells;
  };



  // p4est limits the cells of a rank, and the numbers of the nodes those of all
  // ranks.
  TEST(Grid, MaximumNumberOfCells)
  {
    const double max_n_nodes =
      std::numeric_limits<dealii::types::global_dof_index>::max();
    for (const double n_ranks : {1., 2., 8.})
      EXPECT_EQ(Layout<2>::max_n_cells(n_ranks), 4e8 * n_ranks);
    if (sizeof(dealii::types::global_dof_index) == 4)
      EXPECT_EQ(Layout<3>::max_n_cells(1000.), 0.9 * max_n_nodes);
    EXPECT_LT(Layout<2>::max_n_cells(1e15), max_n_nodes);
  }



  /// Level L of the trees, and how many there are.
  template <int dim>
  void
  expect_trees(const std::string &parameters,
               const unsigned int level,
               const unsigned int n_trees)
  {
    Core<dim> core(parameters);
    EXPECT_EQ(core.grid.triangulation().n_levels(), level + 1) << parameters;
    EXPECT_EQ(core.grid.triangulation().n_cells(0), n_trees) << parameters;
  }



  TEST(Grid, TreesDivideAllAxes)
  {
    expect_trees<2>(mesh("0, 0", "12, 1"), 0, 12); // one cell high
    expect_trees<2>(mesh("0, 0", "12, 4"), 2, 3);
    expect_trees<2>(mesh("0, 0", "24, 16"), 3, 6);
    expect_trees<2>(mesh("0, 0", "320, 8", "0.5"), 3, 160);
    expect_trees<2>(mesh("0, 0", "24, 16") +
                      in_section("Grid", "set Coarsest level = 1"),
                    1,
                    96);
    expect_trees<3>(mesh("0, 0, 0", "8, 4, 2"), 1, 8);
    expect_trees<3>(mesh("0, 0, 0", "4, 4, 1"), 0, 16);
  }



  TEST(Grid, FaceMovesOnlyWhenAllowed)
  {
    const std::string   parameters = mesh("0, 1", "4.1, 4", "0.5");
    std::array<bool, 4> may_move{{true, true, true, true}};
    {
      const Core<2> core(parameters, may_move);
      EXPECT_DOUBLE_EQ(core.grid.domain().upper[0], 4.5);
      EXPECT_DOUBLE_EQ(core.grid.domain().lower[0], 0.);
      EXPECT_DOUBLE_EQ(core.grid.domain().upper[1], 4.);
      EXPECT_EQ(core.grid.cells().size(), 9 * 6u);
      for (const std::string part : {"'Right'", "4.1 m", "4.5 m", "0.5 m"})
        EXPECT_TRUE(contains(core.grid.adjustment(), part))
          << core.grid.adjustment();
      EXPECT_FALSE(contains(core.grid.adjustment(), "'Top'"));
    }
    may_move[1] = false;
    const std::string message =
      message_of<ExcUser>([&]() { Core<2> core(parameters, may_move); });
    EXPECT_TRUE(contains(message, "'Right'")) << message;
    EXPECT_TRUE(contains(message, "Cell size = 0.5")) << message;
  }



  TEST(Grid, RoundOffMovesNoFace)
  {
    // 1e-9 of the length is round-off, 1e-8 is another mesh.
    const Core<2> core(mesh("0, 0", "4.000000003, 4"));
    EXPECT_EQ(core.grid.domain().upper[0], 4.000000003);
    EXPECT_EQ(core.grid.cells().size(), 16u);
    EXPECT_EQ(core.grid.adjustment(), "");
    EXPECT_THROW(Core<2>(mesh("0, 0", "4.00000004, 4")), ExcUser);
  }



  TEST(Grid, CornersMustBeInOrder)
  {
    const std::string message =
      message_of<ExcUser>([]() { Core<2> core(mesh("0, 3", "4, 3")); });
    EXPECT_TRUE(contains(message, "coordinate 1")) << message;
  }



  // ------------------------------------------------------------- neighbours

  /// Whether the closed cells share a point.
  template <int dim>
  bool
  touch(const Cell<dim> &a, const Cell<dim> &b)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (a.lower[d] > b.lower[d] + b.size + 1e-9 ||
          b.lower[d] > a.lower[d] + a.size + 1e-9)
        return false;
    return true;
  }



  template <int dim>
  void
  expect_neighbors_by_geometry(const Grid<dim> &grid)
  {
    for (unsigned int c = 0; c < grid.cells().size(); ++c)
      {
        const Cell<dim>       &cell    = grid.cells()[c];
        bool                   uniform = true;
        std::set<unsigned int> touching;
        for (unsigned int n = 0; n < grid.cells().size(); ++n)
          if (touch(cell, grid.cells()[n]))
            {
              touching.insert(n);
              uniform = uniform && grid.cells()[n].size == cell.size;
            }
        EXPECT_EQ(cell.uniform, uniform) << c;
        if (!uniform)
          {
            const auto &found = grid.touching_cells(c);
            EXPECT_EQ(found.size(), touching.size());
            EXPECT_EQ(std::set<unsigned int>(found.begin(), found.end()),
                      touching);
          }
        std::set<unsigned int> same_size;
        for (unsigned int k = 0; k < cell.neighbors.size(); ++k)
          if (const unsigned int n = cell.neighbors[k];
              n != dealii::numbers::invalid_unsigned_int)
            {
              same_size.insert(n);
              for (unsigned int d = 0; d < dim; ++d)
                EXPECT_NEAR(grid.cells()[n].lower[d],
                            cell.lower[d] +
                              (int(k / power(3, d) % 3) - 1) * cell.size,
                            1e-12);
            }
        for (const unsigned int n : touching)
          EXPECT_EQ(same_size.count(n), grid.cells()[n].size == cell.size);
      }
  }



  /// Beyond the boundary of the mesh the outer row is the boundary row.
  template <int dim>
  void
  expect_patch_by_geometry(const Grid<dim> &grid)
  {
    const auto places = places_of_nodes(grid);
    for (const Cell<dim> &cell : grid.cells())
      for (unsigned int k = 0; k < cell.patch.size(); ++k)
        {
          bool       inner = true;
          Point<dim> expected;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const int at = int(k / power(4, d) % 4) - 1;
              inner        = inner && (at == 0 || at == 1);
              expected[d]  = std::clamp(cell.lower[d] + at * cell.size,
                                       grid.domain().lower[d],
                                       grid.domain().upper[d]);
            }
          // The neighbour that a node of the patch belongs to, if any.
          unsigned int neighbor = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double middle = cell.lower[d] + 0.5 * cell.size;
              const double out    = (expected[d] - middle) / cell.size;
              neighbor += (out < -1. ? 0 : (out > 1. ? 2 : 1)) * power(3, d);
            }
          if (inner ||
              cell.neighbors[neighbor] != dealii::numbers::invalid_unsigned_int)
            {
              ASSERT_LT(cell.patch[k], grid.n_nodes());
              EXPECT_LT(places[cell.patch[k]].distance(expected), 1e-12);
            }
          else
            EXPECT_EQ(cell.patch[k], dealii::numbers::invalid_unsigned_int);
        }
  }



  template <int dim>
  void
  expect_links_by_geometry(Core<dim> &core)
  {
    expect_neighbors_by_geometry(core.grid);
    expect_patch_by_geometry(core.grid);
    refine_corner(core);
    expect_neighbors_by_geometry(core.grid);
    expect_patch_by_geometry(core.grid);
    // Two levels: the balance over corners refines a ring around it.
    core.refine([](const Point<dim> &x) { return x.norm() < 0.6; });
    EXPECT_EQ(core.grid.finest_size(), 0.25);
    expect_neighbors_by_geometry(core.grid);
    expect_patch_by_geometry(core.grid);
  }



  TEST(Grid, NeighborsAndPatchesByGeometry)
  {
    {
      Core<2> core(cube<2>());
      expect_links_by_geometry(core);
    }
    {
      // A sheet: every cell lies at both faces of an axis.
      Core<2> core(mesh("-2, 0", "3, 1"));
      expect_neighbors_by_geometry(core.grid);
      expect_patch_by_geometry(core.grid);
    }
    Core<3> core(cube<3>());
    expect_links_by_geometry(core);
  }



  template <int dim>
  void
  expect_cells_found(Core<dim> &core)
  {
    const auto &grid = core.grid;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        // Half of the places lie outside.
        const Point<dim> x = core.place(-0.4);
        Point<dim>       inside;
        for (unsigned int d = 0; d < dim; ++d)
          inside[d] =
            std::clamp(x[d], grid.domain().lower[d], grid.domain().upper[d]);
        const unsigned int c = grid.find_cell(x);
        ASSERT_LT(c, grid.cells().size());
        for (unsigned int d = 0; d < dim; ++d)
          {
            const Cell<dim> &cell = grid.cells()[c];
            EXPECT_GE(inside[d], cell.lower[d] - 1e-12);
            EXPECT_LE(inside[d], cell.lower[d] + cell.size + 1e-12);
          }
      }
    for (unsigned int c = 0; c < grid.cells().size(); ++c)
      {
        EXPECT_EQ(grid.find_cell(grid.cells()[c].lower), c) << "lower corner";
      }
  }



  TEST(Grid, FindsCellsInsideAndOutside)
  {
    {
      Core<2> core(cube<2>());
      expect_cells_found(core);
      refine_corner(core);
      expect_cells_found(core);
      const double nan = std::nan("");
      EXPECT_LT(core.grid.find_cell({nan, 1e300}), core.grid.cells().size());
    }
    Core<3> core(cube<3>());
    refine_corner(core);
    expect_cells_found(core);
  }
} // namespace
