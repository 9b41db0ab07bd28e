// SPDX-License-Identifier: LGPL-2.1-or-later
// The suite works on any number of ranks; ctest runs it on 1 and 3.
#include "mesh_tracking_setup.h"

namespace
{
  // ------------------------------------------------------------------- extent

  /// Upper corner and message for a mesh of cells of 1 m that may be 16 times
  /// as large far away.
  void
  expect_extent(const std::string         &upper,
                const std::array<bool, 4> &may_move,
                const Point<2>            &expected,
                const std::string         &message)
  {
    Tracked<2> core(mesh("-3, 0", upper) +
                      in_section("Grid", "set Coarsest level = 4"),
                    may_move);
    EXPECT_EQ(core.grid.domain().lower, Point<2>(-3., 0.));
    EXPECT_EQ(core.grid.domain().upper, expected);
    EXPECT_EQ(core.grid.adjustment(), message);
    core.begin({});
    EXPECT_EQ(core.grid.cell_size(), 1.);
  }



  TEST(MeshTracking, OnlyFreeUpperFacesMove)
  {
    const std::string top_16 =
      " The face 'Top' was moved outwards from 30 m to "
      "32 m, so that the largest cells are 16 m long.";
    const std::array<bool, 4> all{{true, true, true, true}};
    const std::array<bool, 4> top{{false, false, false, true}};
    const std::array<bool, 4> walls{};
    expect_extent("61, 32", all, {61., 32.}, "");
    expect_extent("61, 30", all, {61., 32.}, top_16);
    expect_extent("61, 29.5",
                  top,
                  {61., 32.},
                  " The face 'Top' was moved outwards from 29.5 m to 32 m, so "
                  "that the largest cells are 16 m long.");
    expect_extent("50, 32",
                  all,
                  {61., 32.},
                  " The face 'Right' was moved outwards from 50 m to 61 m, so "
                  "that the largest cells are 16 m long.");
    // A wall of 53 m allows no larger cells.
    expect_extent("50, 30", top, {50., 30.}, "");
    // One of 56 m those of 8 m.
    expect_extent("53, 30",
                  top,
                  {53., 32.},
                  " The face 'Top' was moved outwards from 30 m to 32 m, so "
                  "that the largest cells are 8 m long.");
    expect_extent("61, 24", walls, {61., 24.}, "");
  }



  // --------------------------------------------------------- refinement boxes

  /// Whether the inside of the box overlaps the cell.
  template <int dim>
  bool
  overlap(const Cell<dim> &cell, const Box<dim> &box, const double distance)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (cell.lower[d] > box.upper[d] + distance - 1e-9 ||
          cell.lower[d] + cell.size < box.lower[d] - distance + 1e-9)
        return false;
    return true;
  }



  /// A box of twice halved cells: no others in it, and around it none smaller
  /// than those of once halved, but in a ring.
  template <int dim>
  void
  expect_box_of_small_cells(const Grid<dim> &grid, const Box<dim> &box)
  {
    unsigned int n = 0;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        const Cell<dim> &cell = grid.cells()[c];
        if (overlap(cell, box, 0.))
          {
            EXPECT_EQ(cell.size, 0.25) << cell.lower;
            ++n;
          }
        else if (!overlap(cell, box, 0.5))
          {
            EXPECT_GE(cell.size, 0.5) << cell.lower;
          }
        if (!overlap(cell, box, 2.))
          {
            EXPECT_GE(cell.size, 1.) << cell.lower;
          }
      }
    EXPECT_GT(MPI::sum(n, MPI_COMM_WORLD), 0u);
    EXPECT_EQ(grid.finest_size(), 0.25);
    EXPECT_EQ(grid.cell_size(), 1.);
  }



  template <int dim>
  void
  expect_refinement_box()
  {
    // Neither along the lines of the cells, nor within the mesh.
    const Box<dim>    where = box<dim>({10.3, -1., -1.}, {14.1, 2.3, 2.3});
    const std::string entry =
      std::string("set Refinement boxes = ") +
      (dim == 2 ? "10.3,-1; 14.1,2.3; 2" : "10.3,-1,-1; 14.1,2.3,2.3; 2");
    {
      Core<dim> core(
        mesh(dim == 2 ? "0, 0" : "0, 0, 0", dim == 2 ? "24, 8" : "24, 8, 8") +
        in_section("Grid", entry));
      expect_box_of_small_cells(core.grid, where);
    }
    // Far from soil, and then with soil in it, which sees its own margin.
    Tracked<dim> core(long_mesh<dim>(entry));
    core.begin({box<dim>({40., 0., 0.}, {46., 3., 3.})});
    expect_box_of_small_cells(core.grid, where);
    core.put(Point<dim>() + 45. * Point<dim>::unit_vector(0));
    core.put(Point<dim>() + 11. * Point<dim>::unit_vector(0));
    core.sort();
    core.follow();
    expect_box_of_small_cells(core.grid, where);
    const auto soil = places_of_soil(core);
    EXPECT_EQ(soil.size(), 2u);
    for (unsigned int c = 0; c < core.grid.n_owned_cells(); ++c)
      for (const auto &place : soil)
        if (gap(core.grid, c, place) < margin)
          {
            EXPECT_LE(core.grid.cells()[c].size, 1.);
          }
  }



  TEST(MeshTracking, RefinementBoxesHaveTheSizeAskedFor)
  {
    expect_refinement_box<2>();
    expect_refinement_box<3>();
  }
} // namespace
