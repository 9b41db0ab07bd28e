// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_cell_cache_h
#define talus_grid_cell_cache_h

#include <talus/grid/cell.h>
#include <talus/grid/nodal_exchange.h>

#include <unordered_map>
#include <vector>

namespace talus
{
  /// Flat list of cells for the transfer, in the order of the mesh, owned cells
  /// first, then ghost cells; with the neighbours of each cell, and a search
  /// for the cell of a point.
  template <int dim>
  class CellCache
  {
  public:
    const Cells<dim> &
    cells() const
    {
      return cells_;
    }

    unsigned int
    n_owned_cells() const
    {
      return n_owned_cells_;
    }

    unsigned int
    level_of_cell(const unsigned int c) const
    {
      return level_of_cell_[c];
    }

    /// Return the rank that owns the cell.
    unsigned int
    owner_of_cell(const unsigned int c) const
    {
      return c < n_owned_cells_
               ? mesh_.triangulation().locally_owned_subdomain()
               : owner_of_ghost_[c - n_owned_cells_];
    }

    /// Ranks that own ghost cells of this rank, ascending. The relation is
    /// symmetric: this rank owns ghost cells of each neighbour rank.
    const std::vector<unsigned int> &
    neighbor_ranks() const
    {
      return neighbor_ranks_;
    }

    Lattice<dim>
    place_of_cell(unsigned int c) const;

    /// Return the key of a cell, identical on all ranks.
    unsigned long
    key_of_cell(unsigned int c) const;

    /// Return the cell with the given key; invalid_unsigned_int if this rank
    /// does not know the cell.
    unsigned int
    cell_of_key(unsigned long key) const;

    /// Cells of any size that share at least a corner with cell @p c, including
    /// @p c. Stored only for cells that are not uniform.
    const std::vector<unsigned int> &
    touching_cells(const unsigned int c) const
    {
      return touching_.at(c);
    }

    /// Whether points in an owned cell may have weights at a node of a cell
    /// larger than h.
    bool
    is_near_larger_cell(const unsigned int c) const
    {
      return is_near_larger_cell_[c];
    }

    /// Return the cell that contains @p x, m, or the boundary cell nearest to a
    /// position outside of the mesh; invalid_unsigned_int if this rank does not
    /// know the cell.
    unsigned int
    find_cell(const dealii::Point<dim> &x) const;

    /// Index in cells() of an active deal.II cell.
    unsigned int
    index_of(
      const typename dealii::Triangulation<dim>::cell_iterator &cell) const
    {
      return index_of_active_cell_[cell->active_cell_index()];
    }

  protected:
    /// Keeps a reference: the mesh must outlive this object.
    explicit CellCache(const Mesh<dim> &mesh);

    void
    prepare_cells(const NodeNumbering<dim> &nodes);

    /// Find the owned cells near a cell larger than h, for
    /// is_near_larger_cell(). Cells and nodes must be prepared; @p exchange
    /// must carry two doubles per node. Collective.
    void
    find_larger_cells(const NodeNumbering<dim> &nodes,
                      NodalExchange<dim>       &exchange);

  private:
    void
    list_cells(const NodeNumbering<dim> &nodes);
    void
    link_cell(unsigned int c);
    void
    fill_patch(unsigned int c);
    void
    find_touching_cells(unsigned int c);
    unsigned int
    cell_at(const Lattice<dim> &place, unsigned int level) const;

    const Mesh<dim>                                &mesh_;
    Cells<dim>                                      cells_;
    std::vector<unsigned int>                       level_of_cell_;
    std::vector<unsigned int>                       index_of_active_cell_;
    unsigned int                                    n_owned_cells_ = 0;
    std::vector<unsigned int>                       owner_of_ghost_;
    std::vector<unsigned int>                       neighbor_ranks_;
    std::unordered_map<unsigned long, unsigned int> cell_map_;
    std::unordered_map<unsigned int, std::vector<unsigned int>> touching_;
    std::vector<bool> is_near_larger_cell_;
  };
} // namespace talus

#endif
