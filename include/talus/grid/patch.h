// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_patch_h
#define talus_grid_patch_h

namespace talus
{
  constexpr unsigned int
  power(const unsigned int base, const unsigned int exponent)
  {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
  }

  /// Index in a patch of the node of the cell at vertex @p v.
  template <int dim>
  constexpr unsigned int
  patch_of_vertex(const unsigned int v)
  {
    unsigned int k = 0;
    for (unsigned int d = 0; d < dim; ++d)
      k += (1 + ((v >> d) & 1)) * power(4, d);
    return k;
  }
} // namespace talus

#endif
