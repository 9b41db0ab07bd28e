// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/lattice.h>

namespace talus
{
  // 6 bits for the level, the remaining bits divided among the axes. A single
  // number can be hashed and sent in a message. An axis has 29 bits in 2-D and
  // 19 in 3-D; MeshLayout::check_lattice() rejects larger lattices.
  template <int dim>
  unsigned long
  key_of_place(const Lattice<dim> &place, const unsigned int level)
  {
    constexpr unsigned int bits   = 58 / dim;
    unsigned long          result = level;
    for (unsigned int d = 0; d < dim; ++d)
      result = (result << bits) | static_cast<unsigned long>(place[d]);
    return result;
  }



  // p4est divides a cell into 2^dim children, so halving the position along
  // each axis gives the parent. The level must not be zero.
  template <int dim>
  unsigned long
  key_of_parent(const unsigned long key)
  {
    constexpr unsigned int  bits = 58 / dim;
    constexpr unsigned long mask = (1ul << bits) - 1;
    Lattice<dim>            place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = ((key >> (bits * (dim - 1 - d))) & mask) >> 1;
    return key_of_place<dim>(place, (key >> (bits * dim)) - 1);
  }



  template decltype(key_of_place<2>)  key_of_place<2>;
  template decltype(key_of_place<3>)  key_of_place<3>;
  template decltype(key_of_parent<2>) key_of_parent<2>;
  template decltype(key_of_parent<3>) key_of_parent<3>;
} // namespace talus
