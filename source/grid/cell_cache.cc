// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/cell_cache.h>
#include <talus/grid/nodal_exchange.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Digits of @p number to the base @p base, one per axis, x first.
    template <int dim>
    std::array<int, dim>
    digits(unsigned int number, const unsigned int base)
    {
      std::array<int, dim> result;
      for (unsigned int d = 0; d < dim; ++d, number /= base)
        result[d] = number % base;
      return result;
    }



    /// The inverse of digits().
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



  // The transfer asks millions of times a second which nodes are around a
  // place; deal.II's iterators answer that through several tables, and find
  // neighbours of the same size only level by level. So what is needed is
  // written down once per mesh: two lines of the cache per cell in 2-D, seven
  // in 3-D, and a pass over all cells whenever the mesh changes.
  //
  // Own nodes of all cells are there before patches are put together from them.
  template <int dim>
  void
  CellCache<dim>::prepare_cells(const NodeNumbering<dim> &nodes)
  {
    list_cells(nodes);
    touching_.clear();
    // Ghosts are not linked: no point is in them, and not all of their
    // neighbours are known here.
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      link_cell(c);
  }



  /// Fill what a cell knows of itself: place, size and own nodes; and the lists
  /// that go with it. Neighbours come in link_cell().
  template <int dim>
  void
  CellCache<dim>::list_cells(const NodeNumbering<dim> &nodes)
  {
    const auto cells = mesh_.cells_in_order();
    cells_.clear();
    level_of_cell_.clear();
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
        // By the place in the lattice and not by deal.II's vertices, which come
        // from halving after halving: the same whatever the mesh was before.
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



  /// Indices of cells are those of one rank and one mesh; the place in the
  /// lattice of a level is the same for all.
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



  /// Find the neighbours of an owned cell by their places in the lattice of its
  /// level, and with them whether the cell is uniform, that is, all that
  /// touches it has its size or lies beyond the boundary of the mesh.
  ///
  /// This parts the cells for all of the transfer: points in uniform cells find
  /// their nodes in the patch, and only those in other cells that do reach
  /// across pay for weights by definition (see part_from_outsiders()). So a
  /// graded mesh costs where the sizes meet and nowhere else.
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
        // Beyond a periodic face the mesh goes on; beyond another one there is
        // nothing that could have another size.
        if (!inside)
          continue;
        periodicity.wrap(other, extent);
        cell.neighbors[k] = cell_at(other, level);
        if (cell.neighbors[k] != numbers::invalid_unsigned_int)
          continue;
        // A neighbour of another size counts for all sides that it lies at: one
        // across a face, more across an edge or a corner.
        cell.uniform = false;
        for (unsigned int d = 0; d < dim; ++d)
          if (offset[d] != 1)
            cell.sides_of_same_size &= ~(1u << (2 * d + offset[d] / 2));
      }
    fill_patch(c);
    if (!cell.uniform)
      find_touching_cells(c);
  }



  /// Collect the nodes around a cell from the own nodes of its neighbours,
  /// which list_cells() has set. Along each axis entry 0 is the lower node of
  /// the neighbour below, 1 and 2 are the cell's own, and 3 is the upper node
  /// of the neighbour above. At the boundary the outer row is the boundary row
  /// once more: with two weights at one node the shape functions are constant
  /// along the normal there, and a box that dips below the seabed still acts on
  /// the seabed's nodes, with weights that sum to one (doc/method.md, section
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
            // Beyond the boundary: the boundary row once more.
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



  /// List the cells of any size that share a corner with cell @p c, itself
  /// included: what the box of one of its points may overlap. Ascending, so
  /// that sums over them have one order.
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
            // One row of cells of this level around those in which the cell
            // lies, or into which it would be divided.
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



  /// A node is marked if it is a corner of a cell larger than h, on whatever
  /// rank, or hangs on one; or of a small cell that touches a larger one, where
  /// obstacles could not have soil.
  /// Which cells have points that could touch a mark: those with one in their
  /// patch, or in that of a cell that touches them. Nodes and not cells are
  /// marked, as a larger cell may lie beyond the ghosts this rank knows, but
  /// its nodes are known. MeshTracking changes the mesh as soon as such a cell
  /// is occupied.
  template <int dim>
  void
  CellCache<dim>::find_larger_cells(const NodeNumbering<dim> &nodes,
                                    NodalExchange<dim>       &exchange)
  {
    is_near_larger_cell_.assign(n_owned_cells_, false);
    // Of the two numbers that travel for each node, the second is not used.
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



  // By the centre, which round-off cannot move into a neighbour.
  template <int dim>
  Lattice<dim>
  CellCache<dim>::place_of_cell(const unsigned int c) const
  {
    Point<dim> center = cells_[c].lower;
    for (unsigned int d = 0; d < dim; ++d)
      center[d] += 0.5 * cells_[c].size;
    return mesh_.lattice_place(center, level_of_cell_[c]);
  }



  /// The active cell of this level at this place; invalid_unsigned_int if there
  /// is none, or none that this rank knows. Negative numbers would run into the
  /// other fields of the key; places beyond the upper end have keys that no
  /// cell has.
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



  // From the smallest cells on: most points are in one of these. One look into
  // a hash table per level, whatever the number of cells. It is for points that
  // are new or went astray; Relocation::locate() asks the neighbours first.
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
