// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_simd_h
#define talus_base_simd_h

#include <talus/base/always_inline.h>

#include <cmath>
#include <type_traits>
#include <utility>

#if defined(__SSE2__)
#  include <immintrin.h>
#endif

// Several points per instruction, on any processor.
//
// A Simd<n> wraps a vector type of the compiler (the same in GCC and clang), so
// one source serves all processors. It has the width of the registers of the
// target, because GCC translates comparisons, selections and shuffles of wider
// vectors into scalar code through memory. It is a class, so that functions are
// found by argument-dependent lookup. Alternatives: std::experimental::simd
// exists in one standard library only, has no transpose, and computes exp and
// pow entry by entry. Highway's vectors cannot be members of a class, so
// formulas could not be shared with double. deal.II's VectorizedArray has the
// width of the machine for which deal.II was built, a single double in Debian's
// packages. xsimd computes exp, log and pow, see simd_math.h.

#ifndef TALUS_SIMD_WIDTH
#  if defined(__AVX512F__)
#    define TALUS_SIMD_WIDTH 8
#  elif defined(__AVX__)
#    define TALUS_SIMD_WIDTH 4
#  else
#    define TALUS_SIMD_WIDTH 2
#  endif
#endif

// Code that depends on the width is in a namespace named after the width:
// mixing widths is a linker error instead of a wrong result.
#define TALUS_SIMD_PASTE(a, b) a##b
#define TALUS_SIMD_NAME(width) TALUS_SIMD_PASTE(simd_, width)
#define TALUS_SIMD_NAMESPACE TALUS_SIMD_NAME(TALUS_SIMD_WIDTH)

namespace talus
{
  inline namespace TALUS_SIMD_NAMESPACE
  {
    /// Number of doubles in a register.
    constexpr unsigned int simd_width = TALUS_SIMD_WIDTH;

    /// Types of n doubles and of n results of comparisons. For n = 1 scalar
    /// types, so that the same class serves the remaining points.
    template <unsigned int n>
    struct SimdRegister
    {
      typedef double    Doubles __attribute__((vector_size(8 * n)));
      typedef long long Mask __attribute__((vector_size(8 * n)));

      /// Doubles with the alignment of memory. (GCC 12 loses the alignment of a
      /// vector type that depends on n, but not of a structure.)
      struct Unaligned
      {
        Doubles value;
      } __attribute__((packed, aligned(8)));
    };

    template <>
    struct SimdRegister<1>
    {
      using Doubles = double;
      using Mask    = bool;

      struct Unaligned
      {
        double value;
      };
    };



    /// Results of comparisons, for n points.
    template <unsigned int n>
    class SimdMask
    {
    public:
      using Register = typename SimdRegister<n>::Mask;

      Register value;

      SimdMask() = default;

      TALUS_ALWAYS_INLINE
      SimdMask(const Register &value)
        : value(value)
      {}

      /// Inverse of bits(); bits beyond n are ignored.
      static TALUS_ALWAYS_INLINE SimdMask
      of_bits(const unsigned long long bits)
      {
        if constexpr (n == 1)
          return Register((bits & 1) != 0);
        else
          return of_bits(bits, std::make_integer_sequence<int, n>());
      }

      TALUS_ALWAYS_INLINE bool
      operator[](const unsigned int i) const
      {
        if constexpr (n == 1)
          return value;
        else
          return value[i] != 0;
      }

      /// Bit i is set if entry i is true.
      TALUS_ALWAYS_INLINE unsigned int
      bits() const
      {
        if constexpr (n == 1)
          return value;
#if defined(__AVX512DQ__)
        else if constexpr (n == 8)
          return _mm512_movepi64_mask((__m512i)value);
#endif
#if defined(__AVX__)
        else if constexpr (n == 4)
          return _mm256_movemask_pd((__m256d)value);
#endif
#if defined(__SSE2__)
        else if constexpr (n == 2)
          return _mm_movemask_pd((__m128d)value);
#endif
        else
          {
            unsigned int result = 0;
            for (unsigned int i = 0; i < n; ++i)
              result |= (value[i] != 0) << i;
            return result;
          }
      }

      friend TALUS_ALWAYS_INLINE SimdMask
      operator&(const SimdMask &a, const SimdMask &b)
      {
        return Register(a.value & b.value);
      }

      friend TALUS_ALWAYS_INLINE SimdMask
      operator|(const SimdMask &a, const SimdMask &b)
      {
        return Register(a.value | b.value);
      }

      TALUS_ALWAYS_INLINE SimdMask &
      operator|=(const SimdMask &b)
      {
        value = Register(value | b.value);
        return *this;
      }

      TALUS_ALWAYS_INLINE SimdMask &
      operator&=(const SimdMask &b)
      {
        value = Register(value & b.value);
        return *this;
      }

      friend TALUS_ALWAYS_INLINE bool
      any(const SimdMask &mask)
      {
        return mask.bits() != 0;
      }

      friend TALUS_ALWAYS_INLINE bool
      all(const SimdMask &mask)
      {
        return mask.bits() == (1u << n) - 1;
      }

    private:
      template <int... i>
      static TALUS_ALWAYS_INLINE SimdMask
      of_bits(const long long bits, std::integer_sequence<int, i...>)
      {
        const Register bit = {(1ll << i)...};
        return Register(((Register{} + bits) & bit) == bit);
      }
    };



    /// n doubles with the arithmetic of a double: a number at n points.
    template <unsigned int n>
    class Simd
    {
    public:
      using Register = typename SimdRegister<n>::Doubles;
      using Mask     = SimdMask<n>;

      Register value;

      Simd() = default;

      TALUS_ALWAYS_INLINE
      Simd(const Simd &x)
        : value(x.value)
      {}

      TALUS_ALWAYS_INLINE Simd &
      operator=(const Simd &x)
      {
        value = x.value;
        return *this;
      }

      TALUS_ALWAYS_INLINE
      Simd(const double x)
      {
        if constexpr (n == 1)
          value = x;
        else
          value = x - Register{};
      }

      template <unsigned int m, typename = std::enable_if_t<m == n && (n > 1)>>
      TALUS_ALWAYS_INLINE
      Simd(const typename SimdRegister<m>::Doubles &value)
        : value(value)
      {}

      static TALUS_ALWAYS_INLINE Simd
      of(const Register &value)
      {
        Simd x;
        x.value = value;
        return x;
      }

      /// Load n consecutive doubles. Without std::memcpy: the compiler assumes
      /// that it may change any memory and would compute all addresses again.
      static TALUS_ALWAYS_INLINE Simd
      load(const double *from)
      {
        using Unaligned = typename SimdRegister<n>::Unaligned;
        // A copy, since a reference would be assumed to be aligned.
        const Register value = reinterpret_cast<const Unaligned *>(from)->value;
        return of(value);
      }

      TALUS_ALWAYS_INLINE void
      store(double *to) const
      {
        using Unaligned = typename SimdRegister<n>::Unaligned;
        reinterpret_cast<Unaligned *>(to)->value = value;
      }

      TALUS_ALWAYS_INLINE double
      operator[](const unsigned int i) const
      {
        if constexpr (n == 1)
          return value;
        else
          return value[i];
      }

      /// Bit i is set if entry i is negative.
      TALUS_ALWAYS_INLINE unsigned int
      sign_bits() const
      {
#if defined(__AVX__)
        if constexpr (n == 4)
          return _mm256_movemask_pd(value);
#endif
        return (*this < Simd(0.)).bits();
      }

      TALUS_ALWAYS_INLINE Simd &
      operator+=(const Simd &b)
      {
        value += b.value;
        return *this;
      }

      TALUS_ALWAYS_INLINE Simd &
      operator-=(const Simd &b)
      {
        value -= b.value;
        return *this;
      }

      TALUS_ALWAYS_INLINE Simd &
      operator*=(const Simd &b)
      {
        value *= b.value;
        return *this;
      }

      TALUS_ALWAYS_INLINE Simd &
      operator/=(const Simd &b)
      {
        value /= b.value;
        return *this;
      }

      friend TALUS_ALWAYS_INLINE Simd
      operator+(const Simd &a, const Simd &b)
      {
        return of(a.value + b.value);
      }

      friend TALUS_ALWAYS_INLINE Simd
      operator-(const Simd &a, const Simd &b)
      {
        return of(a.value - b.value);
      }

      friend TALUS_ALWAYS_INLINE Simd
      operator*(const Simd &a, const Simd &b)
      {
        return of(a.value * b.value);
      }

      friend TALUS_ALWAYS_INLINE Simd
      operator/(const Simd &a, const Simd &b)
      {
        return of(a.value / b.value);
      }

      friend TALUS_ALWAYS_INLINE Simd
      operator-(const Simd &a)
      {
        return of(-a.value);
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator<(const Simd &a, const Simd &b)
      {
        return Mask(a.value < b.value);
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator>(const Simd &a, const Simd &b)
      {
        return Mask(a.value > b.value);
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator<=(const Simd &a, const Simd &b)
      {
        return Mask(a.value <= b.value);
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator>=(const Simd &a, const Simd &b)
      {
        return Mask(a.value >= b.value);
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator==(const Simd &a, const Simd &b)
      {
        return Mask(a.value == b.value);
      }

      friend TALUS_ALWAYS_INLINE Mask
      operator!=(const Simd &a, const Simd &b)
      {
        return Mask(a.value != b.value);
      }

      friend TALUS_ALWAYS_INLINE Simd
      select(const Mask &mask, const Simd &a, const Simd &b)
      {
        return of(mask.value ? a.value : b.value);
      }

      // a > b ? a : b, also for NaN; GCC does not always find the instruction.
      friend TALUS_ALWAYS_INLINE Simd
      max(const Simd &a, const Simd &b)
      {
#if defined(__AVX512F__)
        if constexpr (n == 8)
          return of(_mm512_max_pd(a.value, b.value));
#endif
#if defined(__AVX__)
        if constexpr (n == 4)
          return of(_mm256_max_pd(a.value, b.value));
#endif
        return select(a > b, a, b);
      }

      friend TALUS_ALWAYS_INLINE Simd
      min(const Simd &a, const Simd &b)
      {
#if defined(__AVX512F__)
        if constexpr (n == 8)
          return of(_mm512_min_pd(a.value, b.value));
#endif
#if defined(__AVX__)
        if constexpr (n == 4)
          return of(_mm256_min_pd(a.value, b.value));
#endif
        return select(a < b, a, b);
      }

      friend TALUS_ALWAYS_INLINE Simd
      sqrt(const Simd &x)
      {
        if constexpr (n == 1)
          return of(std::sqrt(x.value));
#if defined(__AVX512F__)
        else if constexpr (n == 8)
          return of(_mm512_sqrt_pd(x.value));
#endif
#if defined(__AVX__)
        else if constexpr (n == 4)
          return of(_mm256_sqrt_pd(x.value));
#endif
#if defined(__SSE2__)
        else if constexpr (n == 2)
          return of(_mm_sqrt_pd(x.value));
#endif
        else
          {
            Simd root;
            for (unsigned int i = 0; i < n; ++i)
              root.value[i] = std::sqrt(x.value[i]);
            return root;
          }
      }
    };
  } // namespace TALUS_SIMD_NAMESPACE



  // Formulas for points are templates on Number: Simd of the target's width for
  // most points, Simd<1> for the remaining points, double and Dual for single
  // points. The functions below give double the same interface.
  using std::sqrt;

  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  select(const bool mask, const Number &a, const Number &b)
  {
    return mask ? a : b;
  }



  TALUS_ALWAYS_INLINE bool
  any(const bool mask)
  {
    return mask;
  }



  TALUS_ALWAYS_INLINE bool
  all(const bool mask)
  {
    return mask;
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  load(const double *from)
  {
    if constexpr (std::is_same_v<Number, double>)
      return *from;
    else
      return Number::load(from);
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE void
  store(double *to, const Number &value)
  {
    if constexpr (std::is_same_v<Number, double>)
      *to = value;
    else
      value.store(to);
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  max(const Number &a, const Number &b)
  {
    return select(a > b, a, b);
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  min(const Number &a, const Number &b)
  {
    return select(a < b, a, b);
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  clamp(const Number &x, const double lower, const double upper)
  {
    return min(max(x, Number(lower)), Number(upper));
  }



  /// Call @p kernel, with an index and a number of the type to use, for all
  /// points of [begin, end): whole registers first, then single points.
  template <typename Kernel>
  TALUS_ALWAYS_INLINE void
  for_each_simd(const unsigned int begin,
                const unsigned int end,
                Kernel           &&kernel)
  {
    unsigned int p = begin;
    for (; p + simd_width <= end; p += simd_width)
      kernel(p, Simd<simd_width>());
    if constexpr (simd_width > 1)
      for (; p < end; ++p)
        kernel(p, Simd<1>());
  }
} // namespace talus

#endif
