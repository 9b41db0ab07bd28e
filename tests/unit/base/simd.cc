// SPDX-License-Identifier: LGPL-2.1-or-later
// Several numbers per instruction, for all widths whatever the machine has.

#include <talus/base/ordered_sum.h>
#include <talus/base/series.h>
#include <talus/base/simd_math.h>
#include <talus/transfer/transpose.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace
{
  using namespace talus;

  constexpr double epsilon  = std::numeric_limits<double>::epsilon();
  constexpr double infinity = std::numeric_limits<double>::infinity();

  /// Call action(Simd<n>()) for each width n.
  template <typename Action>
  void
  for_widths(const Action &action)
  {
    action(Simd<1>());
    action(Simd<2>());
    action(Simd<4>());
    action(Simd<8>());
  }



  template <unsigned int n>
  constexpr unsigned int
  width_of(const Simd<n> &)
  {
    return n;
  }



  std::uint64_t
  bits_of(const double x)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    return bits;
  }



  /// The same number, or both are none.
  void
  expect_same(const double found, const double expected)
  {
    if (std::isnan(expected))
      EXPECT_TRUE(std::isnan(found)) << found;
    else
      {
        EXPECT_EQ(bits_of(found), bits_of(expected))
          << found << ", not " << expected;
      }
  }



  /// Numbers of both signs and many magnitudes, and what is special about
  /// comparisons.
  std::vector<double>
  numbers(const unsigned int seed)
  {
    std::mt19937        random(seed);
    std::vector<double> x = {
      0., -0., 1., -1., infinity, -infinity, std::nan(""), 1e-310};
    while (x.size() < 64)
      x.push_back((random() % 2 == 0 ? 1. : -1.) *
                  std::exp2(double(random() % 40) - 20.) *
                  (1. + random() / 4294967296.));
    std::shuffle(x.begin(), x.end(), random);
    return x;
  }



  /// What single(a, b) is for doubles, several(a, b) must be in each entry.
  template <typename Several, typename Single>
  void
  expect_as_doubles(const Several &several, const Single &single)
  {
    const auto a = numbers(1), b = numbers(2);
    for_widths([&](const auto type) {
      using Number             = std::decay_t<decltype(type)>;
      constexpr unsigned int n = width_of(Number());
      for (unsigned int i = 0; i < a.size(); i += n)
        {
          const auto found = several(load<Number>(&a[i]), load<Number>(&b[i]));
          for (unsigned int k = 0; k < n; ++k)
            {
              SCOPED_TRACE(std::to_string(a[i + k]) + " and " +
                           std::to_string(b[i + k]));
              expect_same(found[k], single(a[i + k], b[i + k]));
            }
        }
    });
  }

#define EXPECT_AS_DOUBLES(formula)                             \
  {                                                            \
    SCOPED_TRACE(#formula);                                    \
    const auto evaluate = []([[maybe_unused]] const auto &a,   \
                             [[maybe_unused]] const auto &b) { \
      return formula;                                          \
    };                                                         \
    expect_as_doubles(evaluate, evaluate);                     \
  }
} // namespace



TEST(Simd, WidthIsThatOfTheMachine)
{
  EXPECT_TRUE(simd_width == 2 || simd_width == 4 || simd_width == 8);
  for_widths([](const auto type) {
    using Number             = std::decay_t<decltype(type)>;
    constexpr unsigned int n = width_of(Number());
    EXPECT_EQ(sizeof(Number), n * sizeof(double));
    for (const double x : {0.3, -0., infinity})
      for (unsigned int k = 0; k < n; ++k)
        expect_same(Number(x)[k], x);
  });
}



TEST(Simd, Arithmetic)
{
  EXPECT_AS_DOUBLES(a + b);
  EXPECT_AS_DOUBLES(a - b);
  EXPECT_AS_DOUBLES(a * b);
  EXPECT_AS_DOUBLES(a / b);
  EXPECT_AS_DOUBLES(-a);
  EXPECT_AS_DOUBLES(2. + a);
  EXPECT_AS_DOUBLES(a - 2.);
  EXPECT_AS_DOUBLES(2. * a);
  EXPECT_AS_DOUBLES(2. / a);
  EXPECT_AS_DOUBLES(sqrt(a));
  EXPECT_AS_DOUBLES(max(a, b));
  EXPECT_AS_DOUBLES(min(a, b));
  EXPECT_AS_DOUBLES(clamp(a, -0.7, 30.));
}



TEST(Simd, Assignments)
{
  EXPECT_AS_DOUBLES([&] {
    auto sum = a;
    return sum += b;
  }());
  EXPECT_AS_DOUBLES([&] {
    auto difference = a;
    return difference -= b;
  }());
  EXPECT_AS_DOUBLES([&] {
    auto product = a;
    return product *= b;
  }());
  EXPECT_AS_DOUBLES([&] {
    auto quotient = a;
    return quotient /= b;
  }());
}



TEST(Simd, ComparisonsAndSelection)
{
  EXPECT_AS_DOUBLES(a < b);
  EXPECT_AS_DOUBLES(a > b);
  EXPECT_AS_DOUBLES(a <= b);
  EXPECT_AS_DOUBLES(a >= b);
  EXPECT_AS_DOUBLES(a == b);
  EXPECT_AS_DOUBLES(a != b);
  EXPECT_AS_DOUBLES(a == a);
  EXPECT_AS_DOUBLES((a < b) & (a > -b));
  EXPECT_AS_DOUBLES((a < b) | (a < -b));
  EXPECT_AS_DOUBLES([&] {
    auto mask = (a < b);
    mask |= (a < -b);
    return mask &= (a > -2. * b);
  }());
  EXPECT_AS_DOUBLES(select(a < b, a, b));
  EXPECT_AS_DOUBLES(select((a < b) | (b > -1.), 2. * a, a - b));
}



// All patterns of true and false, made by a comparison.
TEST(Simd, AnyAndAll)
{
  EXPECT_TRUE(any(true) && all(true));
  EXPECT_FALSE(any(false) || all(false));
  for_widths([](const auto type) {
    using Number             = std::decay_t<decltype(type)>;
    constexpr unsigned int n = width_of(Number());
    for (unsigned int pattern = 0; pattern < (1u << n); ++pattern)
      {
        std::array<double, n> x;
        for (unsigned int k = 0; k < n; ++k)
          x[k] = ((pattern >> k) & 1 ? 0.5 : -0.5);
        const auto mask = (load<Number>(x.data()) > Number(0.));
        EXPECT_EQ(mask.bits(), pattern);
        EXPECT_EQ(any(mask), pattern != 0);
        EXPECT_EQ(all(mask), pattern + 1 == (1u << n));
        for (unsigned int k = 0; k < n; ++k)
          EXPECT_EQ(mask[k], ((pattern >> k) & 1) == 1);
      }
  });
}



// From any address of a double to any other one, and nothing else is written.
TEST(Simd, LoadAndStoreAnywhere)
{
  alignas(64) std::array<double, 24> from, to;
  for (unsigned int i = 0; i < from.size(); ++i)
    from[i] = 0.1 + i;
  for_widths([&](const auto type) {
    using Number             = std::decay_t<decltype(type)>;
    constexpr unsigned int n = width_of(Number());
    for (unsigned int first = 0; first < 8; ++first)
      for (unsigned int target = 0; target < 8; ++target)
        {
          to.fill(-1.);
          store(&to[target], load<Number>(&from[first]));
          for (unsigned int i = 0; i < to.size(); ++i)
            EXPECT_EQ(to[i],
                      i < target || i >= target + n ? -1.
                                                    : from[first + i - target]);
        }
  });
  store(&to[3], load<double>(&from[5]));
  EXPECT_EQ(to[3], from[5]);
}



TEST(Simd, Transpose)
{
  for_widths([](const auto type) {
    using Number                = std::decay_t<decltype(type)>;
    constexpr unsigned int    n = width_of(Number());
    std::array<double, n * n> entries;
    for (unsigned int i = 0; i < n * n; ++i)
      entries[i] = 0.5 + i;
    Number rows[n];
    for (unsigned int i = 0; i < n; ++i)
      rows[i] = load<Number>(&entries[n * i]);
    transpose(rows);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        EXPECT_EQ(rows[i][j], entries[n * j + i]) << n;
    if constexpr (n > 1)
      {
        const Number halves =
          first_halves(load<Number>(&entries[0]), load<Number>(&entries[n]));
        for (unsigned int j = 0; j < n; ++j)
          EXPECT_EQ(halves[j], entries[j < n / 2 ? j : n / 2 + j]);
      }
  });
}



// Each index once, in ascending order, and no register reaches beyond the end.
TEST(Simd, LoopsMeetEachPointOnce)
{
  for (unsigned int begin = 0; begin < 3; ++begin)
    for (unsigned int size = 0; size < 3 * simd_width; ++size)
      {
        unsigned int next = begin, n_single = 0;
        for_each_simd(begin,
                      begin + size,
                      [&](const unsigned int p, const auto number) {
                        EXPECT_EQ(p, next);
                        next += width_of(number);
                        n_single += (width_of(number) == 1);
                      });
        EXPECT_EQ(next, begin + size);
        EXPECT_LT(n_single, simd_width);
      }
}



TEST(Simd, OrderedSumsAreThoseOfOneByOne)
{
  std::mt19937           random(3);
  std::array<double, 40> x;
  for (double &entry : x)
    entry = random() / 4294967296. - 0.3;
  OrderedSum one_by_one;
  double     expected = 0.;
  for (unsigned int i = 0; i < x.size(); ++i)
    {
      one_by_one.add(i, Simd<1>(x[i]));
      expected += x[i];
    }
  EXPECT_NEAR(one_by_one.total(), expected, 1e-14);
  for_widths([&](const auto type) {
    using Number = std::decay_t<decltype(type)>;
    OrderedSum sum;
    for (unsigned int i = 0; i < x.size(); i += width_of(Number()))
      sum.add(i, load<Number>(&x[i]));
    EXPECT_EQ(bits_of(sum.total()), bits_of(one_by_one.total()));
  });
}



// ---------------------------------------------------------------- functions

namespace
{
  /// What function(x) is in each entry, for Simd<n> of all widths.
  template <typename Function, typename Check>
  void
  for_results(const std::vector<double> &x,
              const Function            &function,
              const Check               &check)
  {
    ASSERT_EQ(x.size() % 8, 0u);
    for_widths([&](const auto type) {
      using Number             = std::decay_t<decltype(type)>;
      constexpr unsigned int n = width_of(Number());
      for (unsigned int i = 0; i < x.size(); i += n)
        {
          const Number found = function(load<Number>(&x[i]));
          for (unsigned int k = 0; k < n; ++k)
            check(i + k, found[k]);
        }
    });
  }



  /// The error is at most @p ulp(x) times that of rounding, and the bits are
  /// the same however many are computed side by side.
  template <typename Function, typename Exact, typename Tolerance>
  void
  expect_exact(const std::vector<double> &x,
               const Function            &function,
               const Exact               &exact,
               const Tolerance           &ulp)
  {
    std::vector<double> alone(x.size());
    for (unsigned int i = 0; i < x.size(); ++i)
      alone[i] = function(Simd<1>(x[i]))[0];
    for_results(x, function, [&](const unsigned int i, const double found) {
      const double expected = exact(x[i]);
      ASSERT_NEAR(found, expected, ulp(x[i]) * epsilon * std::abs(expected))
        << "at " << x[i];
      ASSERT_EQ(bits_of(found), bits_of(alone[i])) << "at " << x[i];
    });
  }



  template <typename Function, typename Exact>
  void
  expect_exact(const std::vector<double> &x,
               const Function            &function,
               const Exact               &exact)
  {
    expect_exact(x, function, exact, [](double) { return 2.; });
  }



  /// Random numbers, all magnitudes side by side.
  template <typename Draw>
  std::vector<double>
  sample(const Draw &draw)
  {
    std::mt19937        random(11);
    std::vector<double> x(80000);
    for (double &entry : x)
      entry = draw([&](const double lower, const double upper) {
        return lower + (upper - lower) * (random() / 4294967295.);
      });
    return x;
  }



  /// At these places, alone and beside each other.
  template <typename Function>
  void
  expect_values(const std::vector<std::pair<double, double>> &values,
                const Function                               &function)
  {
    std::vector<double> x;
    for (unsigned int round = 0; round < 8; ++round)
      for (const auto &value : values)
        x.push_back(value.first);
    for_results(x, function, [&](const unsigned int i, const double found) {
      SCOPED_TRACE("at " + std::to_string(x[i]));
      expect_same(found, values[i % values.size()].second);
    });
  }

  const double not_a_number = std::nan("");

  const auto simd_exp   = [](const auto &x) { return exp(x); };
  const auto simd_expm1 = [](const auto &x) { return expm1(x); };
  const auto simd_log   = [](const auto &x) { return log(x); };
} // namespace



TEST(Simd, Exp)
{
  const auto exact = [](const double x) { return std::exp(x); };
  expect_exact(sample([](auto number) { return number(-708., 709.); }),
               simd_exp,
               exact);
  expect_exact(sample([](auto number) {
                 return number(-1., 1.) * std::exp2(number(-60., 4.));
               }),
               simd_exp,
               exact);
  expect_values({{0., 1.},
                 {-0., 1.},
                 {infinity, infinity},
                 {-infinity, 0.},
                 {800., infinity},
                 {-800., 0.},
                 {1e-300, 1.},
                 {not_a_number, not_a_number}},
                simd_exp);
}



TEST(Simd, Expm1)
{
  const auto exact = [](const double x) { return std::expm1(x); };
  expect_exact(sample([](auto number) { return number(-40., 709.); }),
               simd_expm1,
               exact);
  expect_exact(sample([](auto number) {
                 return number(-1., 1.) * std::exp2(number(-60., 4.));
               }),
               simd_expm1,
               exact);
  expect_values({{0., 0.},
                 {infinity, infinity},
                 {-infinity, -1.},
                 {800., infinity},
                 {-800., -1.},
                 {1e-200, 1e-200},
                 {-1e-200, -1e-200},
                 {not_a_number, not_a_number}},
                simd_expm1);
}



TEST(Simd, Log)
{
  const auto exact = [](const double x) { return std::log(x); };
  expect_exact(sample(
                 [](auto number) { return std::exp2(number(-1021., 1023.)); }),
               simd_log,
               exact);
  expect_exact(sample([](auto number) {
                 return 1. + number(-0.5, 1.) * std::exp2(number(-50., 0.));
               }),
               simd_log,
               exact);
  expect_values({{1., 0.},
                 {0., -infinity},
                 {-0., -infinity},
                 {infinity, infinity},
                 {-1., not_a_number},
                 {-infinity, not_a_number},
                 {-1e-300, not_a_number},
                 {not_a_number, not_a_number}},
                simd_log);
}



// The error of the logarithm is that of the exponent: see pow().
TEST(Simd, Pow)
{
  for (const double exponent : {0.5, 1., 0.37, 2.9, -1.3, 0.})
    {
      SCOPED_TRACE("exponent " + std::to_string(exponent));
      const auto simd_pow = [exponent](const auto &x) {
        return pow(x, exponent);
      };
      expect_exact(
        sample([](auto number) { return std::exp2(number(-200., 200.)); }),
        simd_pow,
        [exponent](const double x) { return std::pow(x, exponent); },
        [exponent](const double x) {
          return 2. + std::abs(exponent * std::log(x));
        });
    }
  expect_values({{0., 0.}, {1., 1.}, {infinity, infinity}},
                [](const auto &x) { return pow(x, 0.7); });
  expect_values({{0., infinity}, {1., 1.}, {infinity, 0.}},
                [](const auto &x) { return pow(x, -0.7); });
}



namespace
{
  /// An entry is the same beside any others.
  template <typename Function>
  void
  expect_independence(const std::vector<double> &x, const Function &function)
  {
    for_widths([&](const auto type) {
      using Number             = std::decay_t<decltype(type)>;
      constexpr unsigned int n = width_of(Number());
      for (unsigned int i = 0; i < x.size(); i += n)
        {
          const Number found = function(load<Number>(&x[i]));
          for (unsigned int k = 0; k < n; ++k)
            ASSERT_EQ(bits_of(found[k]), bits_of(function(Number(x[i + k]))[k]))
              << "at " << x[i + k];
        }
    });
  }



  /// Mostly what a step strains a point by.
  std::vector<double>
  strains()
  {
    return sample([](auto number) {
      return number(-1., 1.) *
             (number(0., 1.) < 0.1 ? 0.9 : std::exp2(number(-50., -5.)));
    });
  }
} // namespace



TEST(Simd, Log1pBySeries)
{
  const auto x        = strains();
  const auto function = [](const auto &x) { return log1p_by_series(x); };
  for_results(x, function, [&](const unsigned int i, const double found) {
    const double expected = std::log1p(x[i]);
    // What is beyond the series is ln of the rounded 1 + x.
    const double rounding = std::abs(x[i]) > 0.02 ? epsilon / (1. + x[i]) : 0.;
    ASSERT_NEAR(found, expected, 3. * epsilon * std::abs(expected) + rounding)
      << x[i];
  });
  expect_independence(x, function);
}
