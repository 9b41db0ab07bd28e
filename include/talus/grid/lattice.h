// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_lattice_h
#define talus_grid_lattice_h

#include <array>

namespace talus
{
  /// Place of a cell in the lattice of its level: how many cells of its size
  /// lie before it along each axis.
  template <int dim>
  using Lattice = std::array<long, dim>;

  /// One number for a place in the lattice of a level, whether or not there is
  /// a cell.
  template <int dim>
  unsigned long
  key_of_place(const Lattice<dim> &place, unsigned int level);

  /// That for what contains it on the level above.
  template <int dim>
  unsigned long
  key_of_parent(unsigned long key);
} // namespace talus

#endif
