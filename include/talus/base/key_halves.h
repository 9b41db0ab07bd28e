// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_key_halves_h
#define talus_base_key_halves_h

#include <array>

namespace talus
{
  /// Return the upper and lower 32 bits of the key of a cell or node, for
  /// tables of doubles: a double cannot hold all bits of a key.
  inline std::array<double, 2>
  halves_of_key(const unsigned long key)
  {
    return {{double(key >> 32), double(key & 0xffffffff)}};
  }



  /// Return the key with the halves @p upper and @p lower of halves_of_key().
  inline unsigned long
  key_of_halves(const double upper, const double lower)
  {
    return (static_cast<unsigned long>(upper) << 32) |
           static_cast<unsigned long>(lower);
  }
} // namespace talus

#endif
