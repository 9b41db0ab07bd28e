// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_ordered_sum_h
#define talus_base_ordered_sum_h

#include <talus/base/simd.h>

#include <array>

namespace talus
{
  /// Sum over consecutive numbers with bit-identical result for any number of
  /// simultaneous additions: number k is added to partial sum k mod 8.
  class OrderedSum
  {
  public:
    /// Add @p numbers with indices k, ..., k + n - 1; @p k must be a multiple
    /// of n.
    template <unsigned int n>
    TALUS_ALWAYS_INLINE void
    add(const unsigned int k, const Simd<n> &numbers)
    {
      static_assert(n <= 8);
      double *const to = sums_.data() + k % 8;
      store(to, load<Simd<n>>(to) + numbers);
    }

    double
    total() const
    {
      const auto &s = sums_;
      return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
    }

  private:
    std::array<double, 8> sums_{};
  };
} // namespace talus

#endif
