#ifndef talus_base_lanes_h
#define talus_base_lanes_h

#include <cmath>
#include <cstring>
#include <initializer_list>

namespace talus
{
  /// Number of points that one pass of a point loop handles side by side.
  constexpr unsigned int n_lanes = 8;

  /// @p n_lanes doubles with the arithmetic of a double (GCC and Clang vector
  /// extension). On machines with shorter registers the compiler splits it.
  using Lanes = double __attribute__((vector_size(8 * n_lanes)));

  /// Result of comparing two Lanes: all bits set where true. `mask ? a : b`
  /// selects lane by lane.
  using LaneMask = decltype(Lanes{} > Lanes{});

  // The one-point formulas are templates on Number, instantiated with Lanes
  // for the bulk and with double for the rest of a range; the functions below
  // let both read the same.

  template <typename Number>
  inline Number
  load(const double *from)
  {
    Number value;
    std::memcpy(&value, from, sizeof(Number));
    return value;
  }



  template <typename Number>
  inline void
  store(double *to, const Number &value)
  {
    std::memcpy(to, &value, sizeof(Number));
  }



  template <typename Number>
  inline Number
  broadcast(const double value)
  {
    return value - Number{};
  }



  template <typename Number>
  inline Number
  max(const Number a, const Number b)
  {
    return a > b ? a : b;
  }



  template <typename Number>
  inline Number
  min(const Number a, const Number b)
  {
    return a < b ? a : b;
  }



  template <typename Number>
  inline Number
  clamp(const Number x, const double lower, const double upper)
  {
    return min(max(x, broadcast<Number>(lower)), broadcast<Number>(upper));
  }



  inline bool
  any(const bool mask)
  {
    return mask;
  }



  inline bool
  any(const LaneMask mask)
  {
    long long all = 0;
    for (unsigned int i = 0; i < n_lanes; ++i)
      all |= mask[i];
    return all != 0;
  }



  inline bool
  all(const bool mask)
  {
    return mask;
  }



  inline bool
  all(const LaneMask mask)
  {
    return !any(mask == LaneMask{});
  }



  /// Lane @p i of a mask.
  inline bool
  is_true(const bool mask, const unsigned int /*i*/)
  {
    return mask;
  }



  inline bool
  is_true(const LaneMask mask, const unsigned int i)
  {
    return mask[i] != 0;
  }



  inline double
  square_root(const double x)
  {
    return std::sqrt(x);
  }



  inline Lanes
  square_root(const Lanes x)
  {
    Lanes root;
    for (unsigned int i = 0; i < n_lanes; ++i)
      root[i] = std::sqrt(x[i]);
    return root;
  }



  inline double
  logarithm(const double x)
  {
    return std::log(x);
  }



  inline Lanes
  logarithm(const Lanes x)
  {
    Lanes result;
    for (unsigned int i = 0; i < n_lanes; ++i)
      result[i] = std::log(x[i]);
    return result;
  }



  inline double
  exponential(const double x)
  {
    return std::exp(x);
  }



  inline Lanes
  exponential(const Lanes x)
  {
    Lanes result;
    for (unsigned int i = 0; i < n_lanes; ++i)
      result[i] = std::exp(x[i]);
    return result;
  }



  /// exp(x) - 1, exact for small x, too.
  inline double
  exponential_minus_1(const double x)
  {
    return std::expm1(x);
  }



  inline Lanes
  exponential_minus_1(const Lanes x)
  {
    Lanes result{};
    for (unsigned int i = 0; i < n_lanes; ++i)
      result[i] = std::expm1(x[i]);
    return result;
  }



  /// exp(x), for small x by a series as quick as it is exact (next term: below
  /// 1e-18 for |x| < 0.02). The strain of one explicit step is smaller.
  template <typename Number>
  inline Number
  exponential_of_step(const Number x)
  {
    const Number series =
      1. +
      x *
        (1. +
         x * (1. / 2. +
              x * (1. / 6. +
                   x * (1. / 24. + x * (1. / 120. +
                                        x * (1. / 720. + x * (1. / 5040.)))))));
    const auto large =
      (x > broadcast<Number>(0.02)) | (x < broadcast<Number>(-0.02));
    if (__builtin_expect(any(large), 0))
      return large ? exponential(x) : series;
    return series;
  }



  inline double
  real_power(const double x, const double exponent)
  {
    return std::pow(x, exponent);
  }



  inline Lanes
  real_power(const Lanes x, const double exponent)
  {
    Lanes result{};
    for (unsigned int i = 0; i < n_lanes; ++i)
      result[i] = std::pow(x[i], exponent);
    return result;
  }



  /// Swap rows and columns: afterwards lane j of rows[i] is what lane i of
  /// rows[j] was.
  inline void
  transpose(Lanes (&rows)[n_lanes])
  {
    static_assert(n_lanes == 8);
    // Blocks of one, two and four entries change sides.
    for (unsigned int i = 0; i < 8; i += 2)
      {
        const Lanes a = rows[i], b = rows[i + 1];
        rows[i]     = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
        rows[i + 1] = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
      }
    for (const unsigned int half : {0, 4})
      for (unsigned int i = half; i < half + 2; ++i)
        {
          const Lanes a = rows[i], b = rows[i + 2];
          rows[i] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
          rows[i + 2] =
            __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Lanes a = rows[i], b = rows[i + 4];
        rows[i]     = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
        rows[i + 4] = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
      }
  }



  /// Sum of the lanes.
  inline double
  sum_of_lanes(const Lanes &x)
  {
    return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
  }



  /// ln(1 + x). One explicit step strains a point by less than a per cent, so
  /// nearly always the series 2 artanh(x/(2+x)) is exact to round-off with the
  /// terms kept here (next one: below 1e-20 relative for |x| < 0.02).
  template <typename Number>
  inline Number
  logarithm_1p(const Number x)
  {
    const Number s = x / (2. + x), s2 = s * s;
    const Number series =
      2. * s *
      (1. + s2 * (1. / 3. + s2 * (1. / 5. + s2 * (1. / 7. + s2 * (1. / 9.)))));
    const auto large =
      (x > broadcast<Number>(0.02)) | (x < broadcast<Number>(-0.02));
    // Lane by lane, so that a point's result never depends on its neighbours.
    if (__builtin_expect(any(large), 0))
      return large ? logarithm(x + 1.) : series;
    return series;
  }



  /// Call @p kernel (with an index and a number type to deduce from) for all
  /// points of [begin, end): eight at a time, then one by one.
  template <typename Kernel>
  inline void
  for_lanes(const unsigned int begin, const unsigned int end, Kernel &&kernel)
  {
    unsigned int p = begin;
    for (; p + n_lanes <= end; p += n_lanes)
      kernel(p, Lanes{});
    for (; p < end; ++p)
      kernel(p, double{});
  }
} // namespace talus

#endif
