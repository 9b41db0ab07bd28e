// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_simd_math_h
#define talus_base_simd_math_h

#include <talus/base/simd.h>

#include <xsimd/xsimd.hpp>

namespace talus
{
  using std::asin;
  using std::cos;
  using std::exp;
  using std::expm1;
  using std::log;
  using std::pow;
  using std::sin;

  inline namespace TALUS_SIMD_NAMESPACE
  {
    /// Apply @p function to registers of xsimd. Simd of another width is copied
    /// through registers of the native width, so that the result at a point
    /// does not depend on the number of points computed together.
    template <unsigned int n, typename Function>
    TALUS_ALWAYS_INLINE Simd<n>
                        by_xsimd(const Simd<n> &x, const Function &function)
    {
      using Batch                 = xsimd::batch<double>;
      constexpr unsigned int size = Batch::size;
      if constexpr (n == size)
        return Simd<n>::of(
          typename Simd<n>::Register(function(Batch(x.value))));
      else
        {
          constexpr unsigned int n_batches = (n + size - 1) / size;
          double                 values[n_batches * size];
          for (unsigned int i = 0; i < n_batches * size; ++i)
            values[i] = x[i < n ? i : 0];
          for (unsigned int b = 0; b < n_batches; ++b)
            function(Batch::load_unaligned(values + b * size))
              .store_unaligned(values + b * size);
          return Simd<n>::load(values);
        }
    }



    /// Exponential of a register. Not inlined: compilers contract the inlined
    /// copies of the formula differently, and one function has one rounding for
    /// Simd of all widths.
    template <typename Batch>
    [[gnu::noinline]] Batch
    exp_of_register(const Batch x)
    {
      return xsimd::exp(x);
    }



    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        exp(const Simd<n> &x)
    {
      return by_xsimd(x, [](const auto &v) { return exp_of_register(v); });
    }



    /// Return exp(x) - 1, accurate also for small x.
    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        expm1(const Simd<n> &x)
    {
      return by_xsimd(x, [](const auto &v) { return xsimd::expm1(v); });
    }



    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        log(const Simd<n> &x)
    {
      return by_xsimd(x, [](const auto &v) { return xsimd::log(v); });
    }



    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        sin(const Simd<n> &x)
    {
      return by_xsimd(x, [](const auto &v) { return xsimd::sin(v); });
    }



    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        cos(const Simd<n> &x)
    {
      return by_xsimd(x, [](const auto &v) { return xsimd::cos(v); });
    }



    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        asin(const Simd<n> &x)
    {
      return by_xsimd(x, [](const auto &v) { return xsimd::asin(v); });
    }



    /// Return x^exponent for x > 0; relative error up to |ln x^exponent| ulp.
    template <unsigned int n>
    TALUS_ALWAYS_INLINE Simd<n>
                        pow(const Simd<n> &x, const double exponent)
    {
      return exp(exponent * log(x));
    }
  } // namespace TALUS_SIMD_NAMESPACE
} // namespace talus

#endif
