// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/cell_cache.h>
#include <talus/grid/nodal_exchange.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Digits of @p number in base @p base, one per axis, x first.
    template <int dim>
    std::array<int, dim>
    digits(unsigned int number, const unsigned int base)
    {
      std::array<int, dim> result;
      for (unsigned int d = 0; d < dim; ++d, number /= base)
        result[d] = number % base;
      return result;
    }



    /// Inverse of digits().
    template <int dim>
    unsigned int
    number(const std::array<int, dim> &digits, const unsigned int base)
    {
      unsigned int result = 0;
      for (int d = dim - 1; d >= 0; --d)
        result = result * base + digits[d];
      return result;
    }
  } // namespace



  template <int dim>
  CellCache<dim>::CellCache(const Mesh<dim> &mesh)
    : mesh_(mesh)
  {}



  // The transfer queries the nodes around a position millions of times per
  // second; iterators of deal.II need several tables for the answer, and find
  // neighbours of equal size only level by level. The cache stores the answers:
  // two cache lines per cell in 2-D, seven in 3-D, and a pass over all cells
  // when the mesh changes.
  //
  // Patches are filled from the nodes of neighbours, so all cells are listed
  // first.
  template <int dim>
  void
  CellCache<dim>::prepare_cells(const NodeNumbering<dim> &nodes)
  {
    list_cells(nodes);
    touching_.clear();
    // Ghost cells are not linked: they contain no points, and this rank does
    // not know all of their neighbours.
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      link_cell(c);
  }



  /// List all cells with position, size and nodes, and fill the tables by cell.
  /// link_cell() finds the neighbours.
  template <int dim>
  void
  CellCache<dim>::list_cells(const NodeNumbering<dim> &nodes)
  {
    const auto cells = mesh_.cells_in_order();
    cells_.clear();
    cells_.reserve(cells.size());
    level_of_cell_.clear();
    level_of_cell_.reserve(cells.size());
    cell_map_.clear();
    cell_map_.reserve(cells.size());
    owner_of_ghost_.clear();
    n_owned_cells_ = 0;
    index_of_active_cell_.assign(mesh_.triangulation().n_active_cells(),
                                 numbers::invalid_unsigned_int);
    for (const auto &cell : cells)
      {
        const unsigned int level = cell->level();
        const auto         place = mesh_.lattice_place(cell->center(), level);
        Cell<dim>          data;
        // Computed from the lattice. The vertices of deal.II come from repeated
        // halving and depend on the history of the mesh.
        data.lower   = mesh_.lower_corner_of(place, level);
        data.size    = mesh_.size_of_level(level);
        data.uniform = false;
        data.patch.fill(numbers::invalid_unsigned_int);
        data.neighbors.fill(numbers::invalid_unsigned_int);
        const auto own_nodes = nodes.nodes_of(cell);
        for (unsigned int v = 0; v < own_nodes.size(); ++v)
          data.patch[patch_of_vertex<dim>(v)] = own_nodes[v];
        if (cell->is_locally_owned())
          ++n_owned_cells_;
        else
          owner_of_ghost_.push_back(cell->subdomain_id());
        index_of_active_cell_[cell->active_cell_index()] = cells_.size();
        cell_map_[key_of_place<dim>(place, level)]       = cells_.size();
        cells_.push_back(data);
        level_of_cell_.push_back(level);
      }
    neighbor_ranks_.assign(owner_of_ghost_.begin(), owner_of_ghost_.end());
    std::sort(neighbor_ranks_.begin(), neighbor_ranks_.end());
    neighbor_ranks_.erase(std::unique(neighbor_ranks_.begin(),
                                      neighbor_ranks_.end()),
                          neighbor_ranks_.end());
  }



  /// Cell indices differ between ranks and meshes; level and position in the
  /// lattice do not.
  template <int dim>
  unsigned long
  CellCache<dim>::key_of_cell(const unsigned int c) const
  {
    return key_of_place<dim>(place_of_cell(c), level_of_cell_[c]);
  }



  template <int dim>
  unsigned int
  CellCache<dim>::cell_of_key(const unsigned long key) const
  {
    const auto it = cell_map_.find(key);
    return it == cell_map_.end() ? numbers::invalid_unsigned_int : it->second;
  }



  /// Find the neighbours of an owned cell from their positions in the lattice
  /// of its level. The cell is uniform if everything that touches it has its
  /// size or lies beyond the boundary of the mesh.
  ///
  /// The transfer treats the two kinds of cells differently: points in uniform
  /// cells find their nodes in the patch. In other cells, points that reach
  /// across need weights by definition (see split_off_irregular_points()). A
  /// graded mesh therefore has extra cost only where sizes meet.
  template <int dim>
  void
  CellCache<dim>::link_cell(const unsigned int c)
  {
    Cell<dim>              &cell        = cells_[c];
    const unsigned int      level       = level_of_cell_[c];
    const Lattice<dim>      place       = place_of_cell(c);
    const Lattice<dim>      extent      = mesh_.extent_of_lattice(level);
    const Periodicity<dim> &periodicity = mesh_.periodicity();

    cell.uniform            = true;
    cell.sides_of_same_size = (1u << (2 * dim)) - 1;
    for (unsigned int k = 0; k < cell.neighbors.size(); ++k)
      {
        const auto   offset = digits<dim>(k, 3);
        Lattice<dim> other  = place;
        bool         inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            other[d] += offset[d] - 1;
            inside = inside && (periodicity.along(d) ||
                                (other[d] >= 0 && other[d] < extent[d]));
          }
        // Beyond a periodic face the mesh continues. Beyond a boundary face no
        // cell exists, hence no cell of another size.
        if (!inside)
          continue;
        // An earlier owned cell has entered itself.
        if (cell.neighbors[k] != numbers::invalid_unsigned_int)
          continue;
        periodicity.wrap(other, extent);
        cell.neighbors[k] = cell_at(other, level);
        if (cell.neighbors[k] != numbers::invalid_unsigned_int)
          {
            if (cell.neighbors[k] < n_owned_cells_)
              cells_[cell.neighbors[k]].neighbors[power(3, dim) - 1 - k] = c;
            continue;
          }
        // A neighbour of another size counts for all sides it touches: one side
        // across a face, several across an edge or corner.
        cell.uniform = false;
        for (unsigned int d = 0; d < dim; ++d)
          if (offset[d] != 1)
            cell.sides_of_same_size &= ~(1u << (2 * d + offset[d] / 2));
      }
    fill_patch(c);
    if (!cell.uniform)
      find_touching_cells(c);
  }



  /// Collect the nodes around a cell from the nodes of its neighbours, set by
  /// list_cells(). Along each axis entry 0 is the lower node of the neighbour
  /// below, entries 1 and 2 are nodes of the cell, and entry 3 is the upper
  /// node of the neighbour above. At the boundary the outer row repeats the
  /// boundary row: with two weights at one node the shape functions are
  /// constant along the normal. A box that dips below the seabed acts on the
  /// nodes of the seabed, with weights that sum to one (doc/method.md, section
  /// 1).
  template <int dim>
  void
  CellCache<dim>::fill_patch(const unsigned int c)
  {
    Cell<dim>         &cell   = cells_[c];
    const Lattice<dim> place  = place_of_cell(c);
    const Lattice<dim> extent = mesh_.extent_of_lattice(level_of_cell_[c]);

    for (unsigned int k = 0; k < cell.patch.size(); ++k)
      {
        auto                 at = digits<dim>(k, 4);
        std::array<int, dim> neighbor, node;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // Beyond the boundary the boundary row is repeated.
            const bool folds = !mesh_.periodicity().along(d);
            if (folds && at[d] == 0 && place[d] == 0)
              at[d] = 1;
            if (folds && at[d] == 3 && place[d] == extent[d] - 1)
              at[d] = 2;
            neighbor[d] = (at[d] == 0 ? 0 : (at[d] == 3 ? 2 : 1));
            node[d]     = (at[d] >= 2 ? 2 : 1);
          }
        const unsigned int n = cell.neighbors[number<dim>(neighbor, 3)];
        if (n != numbers::invalid_unsigned_int)
          cell.patch[k] = cells_[n].patch[number<dim>(node, 4)];
      }
  }



  /// List the cells of any size that share a corner with cell @p c, including
  /// @p c: the box of a point in @p c overlaps no further cells. The list
  /// ascends, so that sums over the cells have a fixed order.
  template <int dim>
  void
  CellCache<dim>::find_touching_cells(const unsigned int c)
  {
    const Lattice<dim>         place    = place_of_cell(c);
    const int                  level    = level_of_cell_[c];
    std::vector<unsigned int> &touching = touching_[c];

    // Neighbours are at most one level apart (2:1 balance over corners).
    for (int l = std::max(level - 1, 0); l <= level + 1; ++l)
      {
        Lattice<dim> first, last;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // Range on level l: the cells that contain cell c or would result
            // from its division, and one row of cells around them.
            first[d] = (l == level + 1 ? 2 * place[d] - 1 : place[d] - 1);
            last[d]  = (l == level + 1 ? 2 * place[d] + 2 : place[d] + 1);
            // Division rounds towards zero, but -1 must remain outside.
            if (l == level - 1)
              {
                first[d] = (first[d] < 0 ? -1 : first[d] / 2);
                last[d] /= 2;
              }
          }
        Lattice<dim> at = first;
        while (at[dim - 1] <= last[dim - 1])
          {
            const unsigned int t = cell_at(at, l);
            if (t != numbers::invalid_unsigned_int)
              touching.push_back(t);
            ++at[0];
            for (unsigned int d = 0; d + 1 < dim && at[d] > last[d]; ++d)
              {
                at[d] = first[d];
                ++at[d + 1];
              }
          }
      }
    std::sort(touching.begin(), touching.end());
  }



  /// Find the cells whose points may touch a marked node. A node is marked if
  /// it is a vertex of a cell larger than h on any rank, or hangs on a marked
  /// node, or is a vertex of a cell that touches a larger cell, since contact
  /// with obstacles needs cells of one size. A cell is near a larger cell if
  /// its patch, or the patch of a touching cell, contains a marked node. Nodes
  /// and not cells are marked: a larger cell may lie beyond the ghost cells of
  /// this rank, but its nodes are known. MeshTracking changes the mesh as soon
  /// as a cell near a larger cell is occupied.
  template <int dim>
  void
  CellCache<dim>::find_larger_cells(const NodeNumbering<dim> &nodes,
                                    NodalExchange<dim>       &exchange)
  {
    is_near_larger_cell_.assign(n_owned_cells_, false);
    // Two numbers per node are exchanged; the second is unused.
    AlignedVector<double> mark(2 * nodes.n_nodes(), 0.);
    const auto            is_larger = [this](const unsigned int c) {
      return level_of_cell_[c] < mesh_.base_level();
    };
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      if (is_larger(c))
        {
          for (const unsigned int node : cells_[c].patch)
            if (node != numbers::invalid_unsigned_int)
              mark[2 * node] = 1.;
        }
      else if (!cells_[c].uniform && std::any_of(touching_cells(c).begin(),
                                                 touching_cells(c).end(),
                                                 is_larger))
        for (const unsigned int node : cells_[c].nodes())
          if (node != numbers::invalid_unsigned_int)
            mark[2 * node] = 1.;
    exchange.add_to_owners(mark.data());
    exchange.copy_to_ghosts(mark.data());
    for (const auto &hanging : nodes.hanging_nodes())
      for (const auto &master : hanging.masters)
        mark[2 * hanging.node] += mark[2 * master.first];

    const auto touches_mark = [&](const unsigned int c) {
      for (const unsigned int node : cells_[c].patch)
        if (node != numbers::invalid_unsigned_int && mark[2 * node] > 0)
          return true;
      return false;
    };
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      if (cells_[c].uniform)
        is_near_larger_cell_[c] = touches_mark(c);
      else
        for (const unsigned int t : touching_cells(c))
          is_near_larger_cell_[c] = is_near_larger_cell_[c] || touches_mark(t);
  }



  // From the centre, which round-off cannot move into a neighbour.
  template <int dim>
  Lattice<dim>
  CellCache<dim>::place_of_cell(const unsigned int c) const
  {
    Point<dim> center = cells_[c].lower;
    for (unsigned int d = 0; d < dim; ++d)
      center[d] += 0.5 * cells_[c].size;
    return mesh_.lattice_place(center, level_of_cell_[c]);
  }



  /// Return the active cell of @p level at @p place; invalid_unsigned_int if
  /// none exists or this rank does not know the cell. Negative coordinates
  /// would overwrite other fields of the key and are excluded first; keys of
  /// places beyond the upper end match no cell.
  template <int dim>
  unsigned int
  CellCache<dim>::cell_at(const Lattice<dim> &place,
                          const unsigned int  level) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (place[d] < 0)
        return numbers::invalid_unsigned_int;
    return cell_of_key(key_of_place<dim>(place, level));
  }



  // Start with the smallest cells, where most points are: one hash lookup per
  // level, for any number of cells. For new points and points far from their
  // old cell; Relocation::locate() tests the neighbours first.
  template <int dim>
  unsigned int
  CellCache<dim>::find_cell(const Point<dim> &x) const
  {
    for (int level = mesh_.triangulation().n_levels() - 1; level >= 0; --level)
      {
        const unsigned int c = cell_at(mesh_.lattice_place(x, level), level);
        if (c != numbers::invalid_unsigned_int)
          return c;
      }
    return numbers::invalid_unsigned_int;
  }



  template class CellCache<2>;
  template class CellCache<3>;
} // namespace talus
