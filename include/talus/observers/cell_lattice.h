// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_cell_lattice_h
#define talus_observers_cell_lattice_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <array>
#include <cstdint>

namespace talus
{
  /// Lattice of cells of size h (`Grid/Cell size`) over the box of the mesh,
  /// independent of the cells of the mesh. y points up: a column is all cells
  /// with the same x (2-D) or x and z (3-D).
  ///
  /// A cell is represented by a number, the key. Keys sort by x, then z, then
  /// y, so the cells of a column follow each other from bottom to top.
  template <int dim>
  class CellLattice
  {
  public:
    using Place = std::array<int, dim>;
    using Key   = std::uint64_t;

    explicit CellLattice(const Grid<dim> &grid);

    /// Return the cell of the centre of point @p p. A centre outside the mesh
    /// is assigned to the nearest boundary cell, as in the transfer.
    Key
    find(const Points<dim> &points, const unsigned int p) const
    {
      Place place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = coordinate(points.data(points.position, d)[p], d);
      return key(place);
    }

    /// Lattice index along axis @p d of the cells at coordinate @p x, m,
    /// clamped to the mesh.
    int
    coordinate(const double x, const unsigned int d) const
    {
      const double at = (x - lower_[d]) / size_;
      // Compared as doubles: a point may be anywhere, or not a number.
      return !(at > 0.)            ? 0
             : at < extent_[d] - 1 ? static_cast<int>(at)
                                   : extent_[d] - 1;
    }

    /// Coordinate of the lower face of the cells with index @p i along axis
    /// @p d, m.
    double
    lower_face(const int i, const unsigned int d) const
    {
      return lower_[d] + i * size_;
    }

    double
    size() const
    {
      return size_;
    }

    /// Key of a cell from the lattice indices. Each index is stored with a
    /// spare value below zero, so that adding the difference of two keys leads
    /// to a neighbour and never wraps around.
    static Key
    key(const Place &place)
    {
      Key result = place[0] + 1;
      if constexpr (dim == 3)
        result = (result << n_bits) | Key(place[2] + 1);
      return (result << n_bits) | Key(place[1] + 1);
    }

    /// Lattice indices of a cell: inverse of key().
    static Place
    place(const Key key)
    {
      Place result;
      result[1] = int(key & mask) - 1;
      if constexpr (dim == 3)
        result[2] = int((key >> n_bits) & mask) - 1;
      result[0] = int(key >> ((dim - 1) * n_bits)) - 1;
      return result;
    }

    /// Number of a column: equal for all cells of the column, different for all
    /// other cells.
    static Key
    column(const Key key)
    {
      return key >> n_bits;
    }

    /// Key of the cell of a column at the bottom face of the mesh.
    static Key
    lowest_cell(const Key column)
    {
      return (column << n_bits) | 1;
    }

    /// Coordinate @p d of the centre of the cell, m.
    double
    center(const Key key, const unsigned int d) const
    {
      return lower_[d] + (place(key)[d] + 0.5) * size_;
    }

  private:
    static constexpr unsigned int n_bits = (dim == 2 ? 31 : 21);
    static constexpr Key          mask   = (Key(1) << n_bits) - 1;

    dealii::Point<dim> lower_;
    double             size_;
    Place              extent_;
  };
} // namespace talus

#endif
