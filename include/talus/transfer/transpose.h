// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_transpose_h
#define talus_transfer_transpose_h

#include <talus/base/simd.h>

#include <utility>

namespace talus
{
  inline namespace TALUS_SIMD_NAMESPACE
  {
    namespace internal
    {
      /// Exchange the off-diagonal blocks of @p size entries of [a; b].
      template <unsigned int size, unsigned int n, int... j>
      TALUS_ALWAYS_INLINE void
      swap_blocks(Simd<n> &a, Simd<n> &b, std::integer_sequence<int, j...>)
      {
        const auto c = a.value, d = b.value;
        a = Simd<n>::of(__builtin_shufflevector(
          c, d, ((j & size) != 0 ? int(n) + j - int(size) : j)...));
        b = Simd<n>::of(__builtin_shufflevector(
          c, d, ((j & size) != 0 ? int(n) + j : j + int(size))...));
      }
    } // namespace internal



    /// Transpose the matrix in place: entry j of rows[i] becomes entry i of
    /// rows[j]. Swaps blocks of one, two and four entries.
    template <unsigned int size = 1, unsigned int n>
    TALUS_ALWAYS_INLINE void
    transpose(Simd<n> *rows)
    {
      if constexpr (size < n)
        {
          for (unsigned int i = 0; i < n; ++i)
            if ((i & size) == 0)
              internal::swap_blocks<size>(rows[i],
                                          rows[i + size],
                                          std::make_integer_sequence<int, n>());
          transpose<2 * size>(rows);
        }
    }



    /// Join the first half of @p a and the first half of @p b.
    template <unsigned int n, int... j>
    TALUS_ALWAYS_INLINE Simd<n>
                        first_halves(const Simd<n> &a,
                                     const Simd<n> &b,
                                     std::integer_sequence<int, j...>)
    {
      return Simd<n>::of(__builtin_shufflevector(
        a.value, b.value, (j < int(n) / 2 ? j : int(n) / 2 + j)...));
    }

    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        first_halves(const Simd<n> &a, const Simd<n> &b)
    {
      return first_halves(a, b, std::make_integer_sequence<int, n>());
    }



    namespace internal
    {
      template <unsigned int n, int... j>
      TALUS_ALWAYS_INLINE void
      store_pairs(double        *to,
                  const Simd<n> &a,
                  const Simd<n> &b,
                  std::integer_sequence<int, j...>)
      {
        constexpr int m = n;
        Simd<n>::of(
          __builtin_shufflevector(a.value, b.value, (j / 2 + j % 2 * m)...))
          .store(to);
        Simd<n>::of(__builtin_shufflevector(a.value,
                                            b.value,
                                            (m / 2 + j / 2 + j % 2 * m)...))
          .store(to + n);
      }
    } // namespace internal

    /// Store a and b interleaved: a[0], b[0], a[1], b[1], ...
    template <unsigned int n>
    TALUS_ALWAYS_INLINE void
    store_pairs(double *to, const Simd<n> &a, const Simd<n> &b)
    {
      if constexpr (n == 1)
        {
          to[0] = a.value;
          to[1] = b.value;
        }
      else
        internal::store_pairs(to, a, b, std::make_integer_sequence<int, n>());
    }
  } // namespace TALUS_SIMD_NAMESPACE
} // namespace talus

#endif
