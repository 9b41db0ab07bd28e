// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_series_h
#define talus_base_series_h

#include <talus/base/simd_math.h>

// Series for small arguments: an explicit step strains a point by less than
// 1 %. The series are exact to round-off for small numbers; larger numbers use
// the exact functions.

namespace talus
{
  /// Whether the series are inexact at @p x, beyond round-off.
  template <typename Number>
  TALUS_ALWAYS_INLINE auto
  is_beyond_series(const Number &x)
  {
    return x * x > Number(0.02 * 0.02);
  }



  /// Return ln(1 + x) by the series of 2 artanh(x/(2+x)). The first neglected
  /// term is below 1e-20 relative for |x| < 0.02.
  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  log1p_by_series(const Number &x)
  {
    const Number s = x / (2. + x), s2 = s * s;
    const Number series =
      2. * s *
      (1. + s2 * (1. / 3. + s2 * (1. / 5. + s2 * (1. / 7. + s2 * (1. / 9.)))));
    const auto large = is_beyond_series(x);
    if (__builtin_expect(any(large), 0))
      return select(large, log(x + 1.), series);
    return series;
  }
} // namespace talus

#endif
