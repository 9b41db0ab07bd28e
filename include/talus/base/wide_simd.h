// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_wide_simd_h
#define talus_base_wide_simd_h

#include <talus/base/simd_math.h>

namespace talus
{
  inline namespace TALUS_SIMD_NAMESPACE
  {
    /// Mask of WideSimd: several registers side by side. For iterations with
    /// dependent steps: the processor works on one register while another waits
    /// for its result.
    template <unsigned int n_parts>
    class WideMask
    {
    public:
      SimdMask<simd_width> part[n_parts];

      friend TALUS_ALWAYS_INLINE WideMask
      operator&(WideMask a, const WideMask &b)
      {
        return a &= b;
      }

      TALUS_ALWAYS_INLINE WideMask &
      operator&=(const WideMask &b)
      {
        for (unsigned int i = 0; i < n_parts; ++i)
          part[i] &= b.part[i];
        return *this;
      }

      friend TALUS_ALWAYS_INLINE bool
      any(const WideMask &mask)
      {
        bool result = false;
        for (unsigned int i = 0; i < n_parts; ++i)
          result |= any(mask.part[i]);
        return result;
      }
    };



    /// More doubles than a register holds: several registers side by side, see
    /// WideMask.
    template <unsigned int n_parts>
    class WideSimd
    {
    public:
      using Part = Simd<simd_width>;
      using Mask = WideMask<n_parts>;

      Part part[n_parts];

      WideSimd() = default;

      TALUS_ALWAYS_INLINE
      WideSimd(const double x)
      {
        for (unsigned int i = 0; i < n_parts; ++i)
          part[i] = x;
      }

      /// Build from @p function(i), the value of register i.
      template <typename Function>
      static TALUS_ALWAYS_INLINE WideSimd
      of(const Function &function)
      {
        WideSimd x;
        for (unsigned int i = 0; i < n_parts; ++i)
          x.part[i] = function(i);
        return x;
      }

      friend TALUS_ALWAYS_INLINE WideSimd
      operator+(const WideSimd &a, const WideSimd &b)
      {
        return of([&](const unsigned int i) { return a.part[i] + b.part[i]; });
      }

      friend TALUS_ALWAYS_INLINE WideSimd
      operator-(const WideSimd &a, const WideSimd &b)
      {
        return of([&](const unsigned int i) { return a.part[i] - b.part[i]; });
      }

      friend TALUS_ALWAYS_INLINE WideSimd
      operator*(const WideSimd &a, const WideSimd &b)
      {
        return of([&](const unsigned int i) { return a.part[i] * b.part[i]; });
      }

      friend TALUS_ALWAYS_INLINE WideSimd
      operator/(const WideSimd &a, const WideSimd &b)
      {
        return of([&](const unsigned int i) { return a.part[i] / b.part[i]; });
      }

      TALUS_ALWAYS_INLINE WideSimd &
      operator+=(const WideSimd &b)
      {
        return *this = *this + b;
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator<(const WideSimd &a, const WideSimd &b)
      {
        Mask mask;
        for (unsigned int i = 0; i < n_parts; ++i)
          mask.part[i] = a.part[i] < b.part[i];
        return mask;
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator>(const WideSimd &a, const WideSimd &b)
      {
        return b < a;
      }

      friend TALUS_ALWAYS_INLINE WideSimd
      select(const Mask &mask, const WideSimd &a, const WideSimd &b)
      {
        return of([&](const unsigned int i) {
          return select(mask.part[i], a.part[i], b.part[i]);
        });
      }

      friend TALUS_ALWAYS_INLINE WideSimd
      sqrt(const WideSimd &x)
      {
        return of([&](const unsigned int i) { return sqrt(x.part[i]); });
      }
    };



    template <unsigned int n_parts>
    TALUS_ALWAYS_INLINE WideSimd<n_parts>
                        exp(const WideSimd<n_parts> &x)
    {
      return WideSimd<n_parts>::of(
        [&](const unsigned int i) { return exp(x.part[i]); });
    }



    template <unsigned int n_parts>
    TALUS_ALWAYS_INLINE WideSimd<n_parts>
                        expm1(const WideSimd<n_parts> &x)
    {
      return WideSimd<n_parts>::of(
        [&](const unsigned int i) { return expm1(x.part[i]); });
    }



    template <unsigned int n_parts>
    TALUS_ALWAYS_INLINE WideSimd<n_parts>
                        pow(const WideSimd<n_parts> &x, const double exponent)
    {
      return WideSimd<n_parts>::of(
        [&](const unsigned int i) { return pow(x.part[i], exponent); });
    }
  } // namespace TALUS_SIMD_NAMESPACE
} // namespace talus

#endif
