// The part of Grid that links cells to their neighbours and to the boundary.

#include <talus/grid/grid.h>

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



  template <int dim>
  void
  Grid<dim>::link_cell(const unsigned int c)
  {
    Cell<dim>         &cell   = cells_[c];
    const Lattice      place  = place_of_cell(c);
    const Lattice      extent = lattice_extent(cell.size);
    const unsigned int level  = level_of_cell_[c];

    cell.uniform = true;
    for (unsigned int k = 0; k < cell.neighbors.size(); ++k)
      {
        const auto offset = digits<dim>(k, 3);
        Lattice    other  = place;
        bool       inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            other[d] += offset[d] - 1;
            inside = inside && other[d] >= 0 && other[d] < extent[d];
          }
        if (!inside)
          continue;
        cell.neighbors[k] = cell_at(other, level);
        if (cell.neighbors[k] == numbers::invalid_unsigned_int)
          cell.uniform = false;
      }
    if (cell.uniform)
      fill_patch(c);
    else
      find_touching_cells(c);
  }



  template <int dim>
  void
  Grid<dim>::fill_patch(const unsigned int c)
  {
    Cell<dim>    &cell   = cells_[c];
    const Lattice place  = place_of_cell(c);
    const Lattice extent = lattice_extent(cell.size);

    for (unsigned int k = 0; k < cell.patch.size(); ++k)
      {
        auto                 at = digits<dim>(k, 4);
        std::array<int, dim> neighbor, node;
        for (unsigned int d = 0; d < dim; ++d)
          {
            // Beyond the boundary: the boundary row once more.
            if (at[d] == 0 && place[d] == 0)
              at[d] = 1;
            if (at[d] == 3 && place[d] == extent[d] - 1)
              at[d] = 2;
            neighbor[d] = (at[d] == 0 ? 0 : (at[d] == 3 ? 2 : 1));
            node[d]     = (at[d] >= 2 ? 2 : 1);
          }
        const unsigned int n = cell.neighbors[number<dim>(neighbor, 3)];
        cell.patch[k]        = cells_[n].patch[number<dim>(node, 4)];
      }
  }



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
            first[d] = (l == level + 1 ? 2 * place[d] - 1 : place[d] - 1);
            last[d]  = (l == level + 1 ? 2 * place[d] + 2 : place[d] + 1);
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



  template <int dim>
  void
  Grid<dim>::list_hanging_nodes()
  {
    const IndexSet &relevant = constraints_.get_local_lines();
    hanging_nodes_.clear();
    for (const auto &line : constraints_.get_lines())
      {
        HangingNode hanging;
        hanging.node = relevant.index_within_set(line.index);
        for (const auto &[master, weight] : line.entries)
          if (relevant.is_element(master))
            hanging.masters.emplace_back(relevant.index_within_set(master),
                                         weight);
        hanging_nodes_.push_back(hanging);
      }
  }



  template <int dim>
  void
  Grid<dim>::mark_boundary_nodes()
  {
    faces_of_node_.assign(n_nodes_, 0);
    for (auto &shares : face_shares_)
      shares.clear();

    for (unsigned int c = 0; c < cells_.size(); ++c)
      {
        const Cell<dim> &cell   = cells_[c];
        const Lattice    place  = place_of_cell(c);
        const Lattice    extent = lattice_extent(cell.size);
        const double     area =
          std::pow(0.5 * cell.size, static_cast<double>(dim - 1));
        for (unsigned int face = 0; face < 2 * dim; ++face)
          {
            const unsigned int d = face / 2, side = face % 2;
            if (place[d] != (side == 0 ? 0 : extent[d] - 1))
              continue;
            for (unsigned int v = 0; v < power(2, dim); ++v)
              {
                auto at = digits<dim>(v, 2);
                if (at[d] != static_cast<int>(side))
                  continue;
                for (auto &a : at)
                  ++a;
                const unsigned int node = cell.patch[number<dim>(at, 4)];
                faces_of_node_[node] |= 1u << face;
                face_shares_[face][node].area += area;
                face_shares_[face][node].volume += area * 0.5 * cell.size;
              }
          }
      }
    for (const auto &hanging : hanging_nodes_)
      for (auto &shares : face_shares_)
        if (const auto it = shares.find(hanging.node); it != shares.end())
          {
            const FaceShare share = it->second;
            shares.erase(it);
            for (const auto &[master, weight] : hanging.masters)
              {
                shares[master].area += weight * share.area;
                shares[master].volume += weight * share.volume;
              }
          }
  }



  template void
  Grid<2>::link_cell(unsigned int);
  template void
  Grid<3>::link_cell(unsigned int);
  template void
  Grid<2>::list_hanging_nodes();
  template void
  Grid<3>::list_hanging_nodes();
  template void
  Grid<2>::mark_boundary_nodes();
  template void
  Grid<3>::mark_boundary_nodes();
} // namespace talus
