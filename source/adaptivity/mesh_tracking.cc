// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/mesh_tracking.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  MeshTracking<dim>::MeshTracking()
    : ParameterAcceptor("/Mesh tracking")
  {
    add_parameter(
      "Enabled",
      enabled_,
      "Whether the mesh follows the soil: cells of 'Grid/Cell size' "
      "at the points and around, up to 2^(Grid/Coarsest level) times "
      "larger cells far away. The results equal the results with small "
      "cells everywhere.");
    add_parameter("Margin",
                  margin_,
                  "Width of the layer of small cells around the soil, in cells "
                  "[-]. The mesh changes when a point comes near its edge.",
                  this->prm,
                  Patterns::Integer(4));
    add_parameter(
      "Interval",
      interval_,
      "Number of steps between two searches for cells that the soil has "
      "left, to coarsen the mesh if a tenth of the small cells is not "
      "needed [-]; 0: coarsen only when the mesh changes for another reason.",
      this->prm,
      Patterns::Integer(0));
  }



  // Test only the occupied cells, by a bit set when the mesh was made
  // (CellCache::find_larger_cells()): the cost per step is negligible. The
  // caller combines the answers of the ranks.
  template <int dim>
  bool
  MeshTracking<dim>::is_urgent(
    const Grid<dim>                 &grid,
    const std::vector<unsigned int> &occupied_cells) const
  {
    if (!enabled_)
      return false;
    for (const unsigned int c : occupied_cells)
      if (grid.is_near_larger_cell(c))
        return true;
    return false;
  }



  namespace
  {
    /// Level of the blocks in which small cells are requested: 4 cells per
    /// axis, where the trees are fine enough. Then 16 cells (64 in 3-D) share
    /// one key to send and look up, and the soil crosses several cells before a
    /// new block is requested.
    template <int dim>
    unsigned int
    block_level(const Grid<dim> &grid)
    {
      return grid.base_level() - std::min(grid.base_level(), 2u);
    }



    /// Add the blocks wanted by all other ranks to @p wanted. All ranks receive
    /// all blocks, as a block may lie in a cell of any rank; messages are short
    /// and rare. Collective.
    template <int dim>
    void
    add_wanted_by_other_ranks(const Grid<dim>                   &grid,
                              std::unordered_set<unsigned long> &wanted)
    {
      const std::vector<unsigned long> own(wanted.begin(), wanted.end());
      for (const auto &blocks :
           Utilities::MPI::all_gather(grid.communicator(), own))
        wanted.insert(blocks.begin(), blocks.end());
    }



    /// Return the key of the block that contains the cell of size h or smaller
    /// at @p place on @p level.
    template <int dim>
    unsigned long
    block_of_cell(const Grid<dim>            &grid,
                  typename Grid<dim>::Lattice place,
                  const unsigned int          level)
    {
      for (auto &p : place)
        p >>= (level - block_level(grid));
      return key_of_place<dim>(place, block_level(grid));
    }



    /// Return the number of cells of size h on all ranks outside of the blocks
    /// @p wanted, divided by the number of all cells of size h. Collective.
    template <int dim>
    double
    share_not_wanted(const Grid<dim>                         &grid,
                     const std::unordered_set<unsigned long> &wanted)
    {
      double n_cells = 0, n_not_wanted = 0;
      for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
        if (grid.level_of_cell(c) == grid.base_level())
          {
            ++n_cells;
            n_not_wanted +=
              1. -
              wanted.count(
                block_of_cell(grid, grid.place_of_cell(c), grid.base_level()));
          }
      n_cells      = Utilities::MPI::sum(n_cells, grid.communicator());
      n_not_wanted = Utilities::MPI::sum(n_not_wanted, grid.communicator());
      return n_cells > 0 ? n_not_wanted / n_cells : 0.;
    }



    /// Refine the mesh to cells of size h in the blocks @p wanted, the same on
    /// all ranks. Returns whether the mesh changed.
    ///
    /// A cell must be refined if it contains a block, so all ancestors of the
    /// blocks are added to the set, level by level: one look-up then answers
    /// for a cell of any size.
    template <int dim>
    bool
    refine(Grid<dim>                        &grid,
           std::unordered_set<unsigned long> wanted,
           const bool                        spread)
    {
      const unsigned int         at_level = block_level(grid);
      std::vector<unsigned long> blocks(wanted.begin(), wanted.end());
      for (unsigned int level = at_level; level > 0; --level)
        {
          for (auto &block : blocks)
            block = key_of_parent<dim>(block);
          std::sort(blocks.begin(), blocks.end());
          blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
          wanted.insert(blocks.begin(), blocks.end());
        }

      return grid.refine(
        [&](typename Grid<dim>::Lattice place, unsigned int level) {
          if (level >= grid.base_level())
            return false;
          return wanted.count(level > at_level
                                ? block_of_cell(grid, place, level)
                                : key_of_place<dim>(place, level)) > 0;
        },
        spread);
    }
  } // namespace



  /// Request small cells from place @p first to place @p last of the lattice of
  /// cells of size h, and in a margin around; the blocks are added to
  /// @p wanted. The margin lets the soil move for a while before the mesh must
  /// change again. Places beyond the boundary are left out.
  template <int dim>
  void
  MeshTracking<dim>::want(const Grid<dim> &grid,
                          const Lattice   &first,
                          const Lattice   &last,
                          Blocks          &wanted) const
  {
    const unsigned int shift  = grid.base_level() - block_level(grid);
    const auto         extent = grid.extent_of_lattice(grid.base_level());
    Lattice            lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::max(first[d] - long(margin_), 0L) >> shift;
        upper[d] = std::min(last[d] + long(margin_), extent[d] - 1) >> shift;
      }
    Lattice at = lower;
    while (at[dim - 1] <= upper[dim - 1])
      {
        wanted.insert(key_of_place<dim>(at, block_level(grid)));
        ++at[0];
        for (unsigned int d = 0; d + 1 < dim && at[d] > upper[d]; ++d)
          {
            at[d] = lower[d];
            ++at[d + 1];
          }
      }
  }



  // Used before points exist, hence boxes instead of occupied cells.
  template <int dim>
  void
  MeshTracking<dim>::adapt(Grid<dim> &grid, const std::vector<Box<dim>> &boxes)
  {
    // A lower bound, as boxes of several bodies may overlap: the list of blocks
    // alone could fill the memory.
    double n_cells = 0.;
    for (const Box<dim> &box : boxes)
      {
        double n_cells_of_box = 0.5;
        for (unsigned int d = 0; d < dim; ++d)
          n_cells_of_box *= box.length(d) / grid.cell_size();
        n_cells += n_cells_of_box;
      }
    grid.check_memory(n_cells);
    Blocks wanted;
    for (const Box<dim> &box : boxes)
      want(grid,
           grid.lattice_place(box.lower, grid.base_level()),
           grid.lattice_place(box.upper, grid.base_level()),
           wanted);
    add_wanted_by_other_ranks(grid, wanted);
    refine(grid, wanted, /*spread=*/true);
  }



  // A change of the mesh takes as long as tens of steps, and empty cells cost
  // nothing in a step: only to coarsen, the mesh changes seldom. The new mesh
  // depends only on the current place of the soil. Points keep their rank;
  // LoadBalance distributes them afterwards.
  template <int dim>
  bool
  MeshTracking<dim>::adapt(Grid<dim>                       &grid,
                           const std::vector<unsigned int> &occupied_cells,
                           const bool                       is_urgent)
  {
    constexpr double min_share_not_wanted = 0.1;
    // Many cells share a block: request each block once.
    const unsigned int at_level = block_level(grid);
    const unsigned int shift    = grid.base_level() - at_level;
    Blocks             occupied, wanted;
    for (const unsigned int c : occupied_cells)
      {
        // Cells in a refinement box are smaller than h; larger cells hold no
        // soil.
        const unsigned int level = grid.level_of_cell(c);
        Lattice            block = grid.place_of_cell(c), first, last;
        for (unsigned int d = 0; d < dim; ++d)
          {
            block[d] = level >= at_level ? block[d] >> (level - at_level)
                                         : block[d] << (at_level - level);
            first[d] = block[d] << shift;
            last[d]  = first[d] + (1l << shift) - 1;
          }
        if (occupied.insert(key_of_place<dim>(block, at_level)).second)
          want(grid, first, last, wanted);
      }
    add_wanted_by_other_ranks(grid, wanted);
    return (is_urgent ||
            share_not_wanted(grid, wanted) > min_share_not_wanted) &&
           refine(grid, wanted, /*spread=*/false);
  }



  template class MeshTracking<2>;
  template class MeshTracking<3>;
} // namespace talus
