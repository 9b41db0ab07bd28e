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
      "where there are points and around them, up to 2^(Grid/"
      "Coarsest level) times larger ones far away. The results are "
      "those of a mesh of small cells everywhere.");
    add_parameter("Margin",
                  margin_,
                  "Width of the layer of small cells around the soil, in cells "
                  "[-]. The mesh changes when a point comes near its edge.",
                  this->prm,
                  Patterns::Integer(4));
    add_parameter(
      "Interval",
      interval_,
      "Number of steps after which cells that the soil has left are "
      "joined [-]; 0 for only when the mesh changes anyway.",
      this->prm,
      Patterns::Integer(0));
  }



  // Only the cells with points are asked, each by a bit that was set when the
  // mesh was made (CellCache::find_larger_cells()): next to nothing per step.
  // Whether any rank says yes takes an operation of all of them.
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
    /// Small cells are asked for in blocks of 4 per axis, where trees allow it.
    /// Sixteen cells (64 in 3-D) then share one key to be sent and looked up,
    /// and the soil moves some cells before it asks for another block.
    template <int dim>
    unsigned int
    block_level(const Grid<dim> &grid)
    {
      return grid.base_level() - std::min(grid.base_level(), 2u);
    }



    /// Make the mesh consist of small cells in the blocks that any rank wants.
    /// All ranks learn all blocks, as a block may lie in a cell of any of them;
    /// these are few numbers, and rarely. A cell is to be divided if it
    /// contains a block, so whoever contains one is entered, too, level by
    /// level: then the question for a cell is one look into a table, whatever
    /// its size.
    template <int dim>
    bool
    refine(Grid<dim>                        &grid,
           std::unordered_set<unsigned long> wanted,
           const bool                        spread)
    {
      // Tell all ranks, and climb from the blocks to what contains them.
      const unsigned int               at_level = block_level(grid);
      const std::vector<unsigned long> own(wanted.begin(), wanted.end());
      for (const auto &blocks :
           Utilities::MPI::all_gather(grid.communicator(), own))
        wanted.insert(blocks.begin(), blocks.end());
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
          // Smaller than a block: as the block it lies in.
          if (level > at_level)
            {
              for (auto &p : place)
                p >>= (level - at_level);
              level = at_level;
            }
          return wanted.count(key_of_place<dim>(place, level)) > 0;
        },
        spread);
    }
  } // namespace



  /// Ask for small cells from place @p first to @p last of the lattice of cells
  /// of size h, and a margin around.
  /// The margin lets the soil move for a while before the mesh must change
  /// again; cells that do not exist beyond the boundary are left out.
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



  // Before there are points: the boxes are those around the bodies to be.
  template <int dim>
  void
  MeshTracking<dim>::adapt(Grid<dim> &grid, const std::vector<Box<dim>> &boxes)
  {
    Blocks wanted;
    for (const Box<dim> &box : boxes)
      want(grid,
           grid.lattice_place(box.lower, grid.base_level()),
           grid.lattice_place(box.upper, grid.base_level()),
           wanted);
    refine(grid, wanted, /*spread=*/true);
  }



  // What is wanted follows from where the soil is now: cells that it has left
  // become larger at once, and two runs that come to the same soil have
  // the same mesh. Points keep their rank here; LoadBalance shares them out
  // afterwards.
  template <int dim>
  bool
  MeshTracking<dim>::adapt(Grid<dim>                       &grid,
                           const std::vector<unsigned int> &occupied_cells)
  {
    // Many cells share a block: ask once for each block.
    const unsigned int at_level = block_level(grid);
    const unsigned int shift    = grid.base_level() - at_level;
    Blocks             occupied, wanted;
    for (const unsigned int c : occupied_cells)
      {
        // In a refinement box cells are smaller; larger ones hold no soil.
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
    return refine(grid, wanted, /*spread=*/false);
  }



  template class MeshTracking<2>;
  template class MeshTracking<3>;
} // namespace talus
