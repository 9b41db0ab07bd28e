// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_cell_h
#define talus_grid_cell_h

#include <talus/base/box.h>
#include <talus/base/large_pages.h>
#include <talus/grid/patch.h>

#include <deal.II/base/point.h>

#include <array>

namespace talus
{
  /// Data of a cell of the background grid for the transfer. In 2-D two cache
  /// lines: first the data for locating points, then the patch.
  template <int dim>
  struct alignas(64) Cell
  {
    dealii::Point<dim> lower; ///< lower corner, m
    double             size;  ///< length of the edges, m

    /// True if all neighbours, also across edges and corners, have the size of
    /// the cell. Then the patch is complete.
    bool uniform;

    /// Bit 2 d (2 d + 1) is set if all neighbours at the lower (upper) face of
    /// axis d, including its edges and corners, have the size of the cell, or
    /// if the mesh ends at the face.
    unsigned char sides_of_same_size;

    /// Indices of the neighbours of equal size, 3 per axis, x fastest, with the
    /// cell in the middle. invalid_unsigned_int beyond the boundary of the mesh
    /// or where no active cell of equal size exists.
    std::array<unsigned int, power(3, dim)> neighbors;

    /// Nodes from one cell below to one cell above, 4 per axis, x fastest. The
    /// inner 2^dim entries are the nodes of the cell. Beyond the boundary of
    /// the mesh the outer row repeats the boundary row: the boundary cell is
    /// continued outwards with shape functions that are constant along the
    /// normal. invalid_unsigned_int where no neighbour of equal size exists.
    std::array<unsigned int, power(4, dim)> patch;

    /// Return the nodes of the cell in the order of deal.II, x fastest.
    std::array<unsigned int, power(2, dim)>
    nodes() const
    {
      std::array<unsigned int, power(2, dim)> result;
      for (unsigned int v = 0; v < result.size(); ++v)
        result[v] = patch[patch_of_vertex<dim>(v)];
      return result;
    }

    /// Position of vertex @p v, in the order of nodes(), m.
    dealii::Point<dim>
    vertex(const unsigned int v) const
    {
      dealii::Point<dim> x = lower;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += ((v >> d) & 1) * size;
      return x;
    }

    Box<dim>
    box() const
    {
      return {lower, vertex(power(2, dim) - 1)};
    }
  };



  /// Whether entry @p k of a patch is a node of the cell.
  template <int dim>
  constexpr bool
  is_own_node(const unsigned int k)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (const unsigned int at = k / power(4, d) % 4; at == 0 || at == 3)
        return false;
    return true;
  }



  template <int dim>
  using Cells = LargePageVector<Cell<dim>>;
} // namespace talus

#endif
