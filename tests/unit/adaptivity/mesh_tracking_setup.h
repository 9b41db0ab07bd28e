// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef mesh_tracking_setup_h
#define mesh_tracking_setup_h

#include <talus/adaptivity/mesh_tracking.h>

#include <set>

#include "ranks_setup.h"

namespace
{
  constexpr long margin = 5;

  /// A mesh that follows the soil: h = 1 m, free at the upper faces unless
  /// said otherwise.
  template <int dim>
  struct Tracked : Core<dim>
  {
    explicit Tracked(const std::string              &text,
                     const std::array<bool, 2 *dim> &may_move = free_above())
      : Core<dim>(cube<dim>())
    {
      // Instead of the mesh of small cells that all other tests begin with.
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        text + in_section("Mesh tracking",
                          "set Enabled = true\nset Margin = " +
                            std::to_string(margin)));
      dealii::ParameterAcceptor::parse_all_parameters();
      this->grid.create(may_move, /*grow=*/true);
      this->grid.prepare();
    }

    static std::array<bool, 2 * dim>
    free_above()
    {
      std::array<bool, 2 * dim> faces{};
      for (unsigned int d = 0; d < dim; ++d)
        faces[2 * d + 1] = true;
      return faces;
    }

    /// Mesh of cells around these boxes, which the bodies will fill.
    void
    begin(const std::vector<Box<dim>> &boxes)
    {
      tracking.adapt(this->grid, boxes);
      prepare();
    }

    /// Mesh of the points as they are. Returns whether it changed.
    bool
    follow(const bool is_urgent = true)
    {
      const bool changed = tracking.adapt(this->grid,
                                          this->relocation.occupied_cells(),
                                          is_urgent);
      prepare();
      return changed;
    }

    void
    prepare()
    {
      this->grid.prepare();
      this->nodes.prepare(this->grid);
      this->relocation.rebuild(this->points, this->grid);
    }

    /// A point without extent, on the rank that owns its place.
    void
    put(const Point<dim> &x)
    {
      if (this->grid.find_cell(x) < this->grid.n_owned_cells())
        this->add(x, Tensor<1, dim>());
    }

    MeshTracking<dim> tracking;
  };



  /// A box with these corners; lists that are too long are cut.
  template <int dim>
  Box<dim>
  box(const Point<3> &lower, const Point<3> &upper)
  {
    Box<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.lower[d] = lower[d];
        result.upper[d] = upper[d];
      }
    return result;
  }



  template <int dim>
  std::string
  long_mesh(const std::string &entries = "")
  {
    return (dim == 2 ? mesh("0, 0", "64, 32") : mesh("0, 0, 0", "64, 16, 16")) +
           in_section("Grid", "set Coarsest level = 4\n" + entries);
  }



  /// Size and place of all cells of all ranks.
  template <int dim>
  std::set<unsigned long>
  all_cells(const Grid<dim> &grid)
  {
    std::set<unsigned long> own, all;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      own.insert(grid.key_of_cell(c));
    for (const auto &part : MPI::all_gather(grid.communicator(), own))
      all.insert(part.begin(), part.end());
    return all;
  }



  /// How many cells of size h lie between a cell of the mesh and the place of a
  /// cell of size h; 0 if they touch.
  template <int dim>
  long
  gap(const Grid<dim>                   &grid,
      const unsigned int                 c,
      const typename Grid<dim>::Lattice &soil)
  {
    const double h      = grid.cell_size();
    long         result = -1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const long first =
          std::lround((grid.cells()[c].lower[d] - grid.domain().lower[d]) / h);
        const long last = first + std::lround(grid.cells()[c].size / h) - 1;
        result = std::max({result, first - soil[d] - 1, soil[d] - last - 1});
      }
    return result;
  }



  template <int dim>
  std::vector<typename Grid<dim>::Lattice>
  places_of_soil(const Core<dim> &core)
  {
    std::vector<typename Grid<dim>::Lattice> own, all;
    for (const unsigned int c : core.relocation.occupied_cells())
      {
        Point<dim> centre = core.grid.cells()[c].lower;
        for (unsigned int d = 0; d < dim; ++d)
          centre[d] += 0.5 * core.grid.cells()[c].size;
        own.push_back(core.grid.lattice_place(centre, core.grid.base_level()));
      }
    for (const auto &part : MPI::all_gather(core.grid.communicator(), own))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }



  /// Cells of size h up to the margin, larger ones beyond, trees far away.
  template <int dim>
  void
  expect_mesh_around_soil(const Core<dim> &core)
  {
    const auto   soil = places_of_soil(core);
    const double h    = core.grid.cell_size();
    for (unsigned int c = 0; c < core.grid.n_owned_cells(); ++c)
      {
        long least = std::numeric_limits<long>::max();
        for (const auto &place : soil)
          least = std::min(least, gap(core.grid, c, place));
        const double size = core.grid.cells()[c].size;
        const auto  &at   = core.grid.cells()[c].lower;
        if (least < margin)
          {
            EXPECT_EQ(size, h) << at;
          }
        // Around blocks of 4 cells and in blocks of 4 cells; then come rings of
        // 2 h, 4 h and 8 h, each up to the next line of its parents.
        if (least >= margin + 6)
          {
            EXPECT_GT(size, h) << at;
          }
        if (least >= margin + 6 + 4 + 8 + 16)
          {
            EXPECT_EQ(size, 16 * h) << at;
          }
      }
  }
} // namespace

#endif
