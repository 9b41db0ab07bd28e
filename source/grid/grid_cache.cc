// SPDX-License-Identifier: LGPL-2.1-or-later
// The part of Grid that links cells to their neighbours and to the boundary.

#include <talus/grid/grid.h>
#include <talus/grid/nodal_exchange.h>

#include <algorithm>
#include <cmath>

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
  Grid<dim>::link_cell(const unsigned int c)
  {
    Cell<dim>         &cell   = cells_[c];
    const Lattice      place  = place_of_cell(c);
    const Lattice      extent = extent_of_lattice(level_of_cell_[c]);
    const unsigned int level  = level_of_cell_[c];

    cell.uniform            = true;
    cell.sides_of_same_size = (1u << (2 * dim)) - 1;
    for (unsigned int k = 0; k < cell.neighbors.size(); ++k)
      {
        const auto offset = digits<dim>(k, 3);
        Lattice    other  = place;
        bool       inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            other[d] += offset[d] - 1;
            inside = inside && (periodicity_.along(d) ||
                                (other[d] >= 0 && other[d] < extent[d]));
          }
        // Beyond a periodic face the mesh goes on; beyond another one there is
        // nothing that could have another size.
        if (!inside)
          continue;
        periodicity_.wrap(other, extent);
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
  Grid<dim>::fill_patch(const unsigned int c)
  {
    Cell<dim>    &cell   = cells_[c];
    const Lattice place  = place_of_cell(c);
    const Lattice extent = extent_of_lattice(level_of_cell_[c]);

    for (unsigned int k = 0; k < cell.patch.size(); ++k)
      {
        auto                 at = digits<dim>(k, 4);
        std::array<int, dim> neighbor, node;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // Beyond the boundary: the boundary row once more.
            const bool folds = !periodicity_.along(d);
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
  Grid<dim>::find_touching_cells(const unsigned int c)
  {
    const Lattice              place    = place_of_cell(c);
    const int                  level    = level_of_cell_[c];
    std::vector<unsigned int> &touching = touching_[c];

    // Neighbours are at most one level apart (2:1 balance over corners).
    for (int l = std::max(level - 1, 0); l <= level + 1; ++l)
      {
        Lattice first, last;
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
        Lattice at = first;
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



  /// Which nodes lie on which faces, and what they stand for there: summed over
  /// the cells of all ranks.
  /// The shape functions are bilinear, so the integral of one over a face of
  /// its cell is (size/2)^(dim-1), and over the cell (size/2)^dim: no
  /// quadrature. Each cell is counted by its owner only. A hanging node carries
  /// nothing, so its share goes to its masters as its forces do; the sum over
  /// the nodes remains the area of the face.
  template <int dim>
  void
  Grid<dim>::mark_boundary_nodes(NodalExchange<dim> &exchange)
  {
    faces_of_node_.assign(n_nodes(), 0);
    for (unsigned int c = 0; c < cells_.size(); ++c)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        for (const unsigned int node : nodes_on_face(c, face))
          faces_of_node_[node] |= 1u << face;

    AlignedVector<double> shares(2 * n_nodes());
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        shares.fill(0.);
        for (unsigned int c = 0; c < n_owned_cells_; ++c)
          {
            const double length = 0.5 * cells_[c].size;
            const double area   = std::pow(length, dim - 1.);
            for (const unsigned int node : nodes_on_face(c, face))
              {
                shares[2 * node] += area;
                shares[2 * node + 1] += area * length;
              }
          }
        for (const auto &hanging : hanging_nodes_)
          for (unsigned int i = 0; i < 2; ++i)
            {
              for (const auto &[master, weight] : hanging.masters)
                shares[2 * master + i] += weight * shares[2 * hanging.node + i];
              shares[2 * hanging.node + i] = 0;
            }
        exchange.add_to_owners(shares.data());
        face_shares_[face].clear();
        for (unsigned int node = 0; node < n_owned_nodes(); ++node)
          // Few nodes lie on a face: a table by node would be empty but for
          // them.
          if (shares[2 * node] > 0)
            face_shares_[face][node] = {shares[2 * node], shares[2 * node + 1]};
      }
  }



  /// A node is marked if it is a corner of a cell larger than h, on whatever
  /// rank, or hangs on one.
  /// Which cells have points that could touch a mark: those with one in their
  /// patch, or in that of a cell that touches them. Nodes and not cells are
  /// marked, as a larger cell may lie beyond the ghosts this rank knows, but
  /// its nodes are known. MeshTracking changes the mesh as soon as such a cell
  /// is occupied.
  template <int dim>
  void
  Grid<dim>::find_larger_cells(NodalExchange<dim> &exchange)
  {
    is_near_larger_cell_.assign(n_owned_cells_, false);
    // Of the two numbers that travel for each node, the second is not used.
    AlignedVector<double> mark(2 * n_nodes(), 0.);
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      if (level_of_cell_[c] < base_level_)
        for (const unsigned int node : cells_[c].patch)
          if (node != numbers::invalid_unsigned_int)
            mark[2 * node] = 1.;
    exchange.add_to_owners(mark.data());
    exchange.copy_to_ghosts(mark.data());
    for (const auto &hanging : hanging_nodes_)
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



  /// The nodes of cell @p c on face @p face of the mesh; none if the cell does
  /// not lie at it, or if the face is periodic, and so no boundary.
  template <int dim>
  std::vector<unsigned int>
  Grid<dim>::nodes_on_face(const unsigned int c, const unsigned int face) const
  {
    const Lattice      place  = place_of_cell(c);
    const Lattice      extent = extent_of_lattice(level_of_cell_[c]);
    const unsigned int d = face / 2, side = face % 2;
    if (periodicity_.along(d) || place[d] != (side == 0 ? 0 : extent[d] - 1))
      return {};
    std::vector<unsigned int> nodes;
    for (unsigned int v = 0; v < power(2, dim); ++v)
      {
        auto at = digits<dim>(v, 2);
        if (at[d] != static_cast<int>(side))
          continue;
        for (auto &a : at)
          ++a;
        nodes.push_back(cells_[c].patch[number<dim>(at, 4)]);
      }
    return nodes;
  }



  // grid.cc instantiates the class, but does not see what is defined here.
  template void
  Grid<2>::link_cell(unsigned int);
  template void
  Grid<3>::link_cell(unsigned int);
  template void
  Grid<2>::find_larger_cells(NodalExchange<2> &);
  template void
  Grid<3>::find_larger_cells(NodalExchange<3> &);
  template std::vector<unsigned int>
  Grid<2>::nodes_on_face(unsigned int, unsigned int) const;
  template std::vector<unsigned int>
  Grid<3>::nodes_on_face(unsigned int, unsigned int) const;
  template void
  Grid<2>::mark_boundary_nodes(NodalExchange<2> &);
  template void
  Grid<3>::mark_boundary_nodes(NodalExchange<3> &);
} // namespace talus
