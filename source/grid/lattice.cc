// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/lattice.h>

namespace talus
{
  // 6 bits for the level, the rest shared by the axes.
  // A place is one number so that it can be looked up by one hash and sent in a
  // message. That leaves 29 bits for an axis in 2-D and 19 in 3-D;
  // Grid::create() refuses meshes whose lattice is larger.
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



  // Halving the place along each axis is what p4est's division into 2^dim
  // children means. The level must not be that of the trees.
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
