// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_lattice_h
#define talus_grid_lattice_h

#include <array>

namespace talus
{
  /// Position of a cell in the lattice of its level: number of cells of equal
  /// size before the cell along each axis.
  template <int dim>
  using Lattice = std::array<long, dim>;

  /// Return the key of a position in the lattice of a level, also where no cell
  /// exists.
  template <int dim>
  unsigned long
  key_of_place(const Lattice<dim> &place, unsigned int level);

  /// Return the key of the parent cell, one level coarser, from the key of a
  /// cell.
  template <int dim>
  unsigned long
  key_of_parent(unsigned long key);
} // namespace talus

#endif
