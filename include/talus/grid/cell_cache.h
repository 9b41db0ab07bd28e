// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_cell_cache_h
#define talus_grid_cell_cache_h

#include <talus/grid/cell.h>
#include <talus/grid/nodal_exchange.h>

#include <unordered_map>
#include <vector>

namespace talus
{
  /// The cells as the transfer sees them: flat, in the order of the mesh, those
  /// this rank owns first, then its ghosts; what lies around each; and which
  /// cell a point is in.
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

    /// Rank that owns the cell.
    unsigned int
    owner_of_cell(const unsigned int c) const
    {
      return c < n_owned_cells_
               ? mesh_.triangulation().locally_owned_subdomain()
               : owner_of_ghost_[c - n_owned_cells_];
    }

    /// Ranks that own ghost cells of this one, ascending; this rank owns ghost
    /// cells of theirs.
    const std::vector<unsigned int> &
    neighbor_ranks() const
    {
      return neighbor_ranks_;
    }

    Lattice<dim>
    place_of_cell(unsigned int c) const;

    /// Name of a cell that all ranks know it by.
    unsigned long
    key_of_cell(unsigned int c) const;

    /// The inverse of key_of_cell(); invalid_unsigned_int if this rank does not
    /// know the cell.
    unsigned int
    cell_of_key(unsigned long key) const;

    /// The cells that share at least a corner with cell @p c, itself included,
    /// whatever their size; kept only for cells that are not uniform.
    const std::vector<unsigned int> &
    touching_cells(const unsigned int c) const
    {
      return touching_.at(c);
    }

    /// Whether the points of an owned cell may touch a node of a cell larger
    /// than h.
    bool
    is_near_larger_cell(const unsigned int c) const
    {
      return is_near_larger_cell_[c];
    }

    /// The cell that contains @p x, which is moved onto the mesh first where it
    /// lies outside; invalid_unsigned_int if this rank does not know that cell.
    unsigned int
    find_cell(const dealii::Point<dim> &x) const;

    /// Index among cells() of an active deal.II cell.
    unsigned int
    index_of(
      const typename dealii::Triangulation<dim>::cell_iterator &cell) const
    {
      return index_of_active_cell_[cell->active_cell_index()];
    }

  protected:
    /// The mesh must live as long as this.
    explicit CellCache(const Mesh<dim> &mesh);

    void
    prepare_cells(const NodeNumbering<dim> &nodes);

    /// Learn which cells are near a larger one, when they and the nodes are
    /// known. @p exchange has two doubles per node. Collective.
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
