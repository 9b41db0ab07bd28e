// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/dual.h>

#include <gtest/gtest.h>

using namespace talus;

namespace
{
  using Number = Dual<2>;

  /// The variables x and y at a place.
  std::pair<Number, Number>
  variables(const double x, const double y)
  {
    Number a = x, b = y;
    a.derivative[0] = 1.;
    b.derivative[1] = 1.;
    return {a, b};
  }



  void
  expect(const Number &found,
         const double  value,
         const double  by_x,
         const double  by_y)
  {
    EXPECT_DOUBLE_EQ(found.value, value);
    EXPECT_NEAR(found.derivative[0], by_x, 4e-16 * (1. + std::abs(by_x)));
    EXPECT_NEAR(found.derivative[1], by_y, 4e-16 * (1. + std::abs(by_y)));
  }
} // namespace



TEST(Dual, ConstantsAndVariables)
{
  const auto [x, y] = variables(3., -2.);
  expect(Number(), 0., 0., 0.);
  expect(7., 7., 0., 0.);
  expect(x, 3., 1., 0.);
  expect(y, -2., 0., 1.);
  EXPECT_TRUE(y < x && x > y && x > 2. && 4. > x);
  EXPECT_FALSE(x < y || x < 3. || x > 3.);
}



TEST(Dual, Arithmetic)
{
  const double u = 1.75, v = -0.6;
  const auto [x, y] = variables(u, v);
  expect(-x, -u, -1., 0.);
  expect(x + y, u + v, 1., 1.);
  expect(x - y, u - v, 1., -1.);
  expect(x * y, u * v, v, u);
  expect(x / y, u / v, 1. / v, -u / (v * v));
  // With a number on either side.
  expect(2. + x, 2. + u, 1., 0.);
  expect(2. - x, 2. - u, -1., 0.);
  expect(x - 2., u - 2., 1., 0.);
  expect(2. * x, 2. * u, 2., 0.);
  expect(2. / x, 2. / u, -2. / (u * u), 0.);
  expect(x / 2., u / 2., 0.5, 0.);
}



// An operand that is also the result.
TEST(Dual, WithItself)
{
  const auto [x, y] = variables(1.75, -0.6);
  Number a          = x;
  expect(a += a, 3.5, 2., 0.);
  a = x;
  expect(a -= a, 0., 0., 0.);
  a = x;
  expect(a *= a, 1.75 * 1.75, 3.5, 0.);
  a = x * y;
  expect(a /= a, 1., 0., 0.);
}



TEST(Dual, Functions)
{
  const double u = 1.75;
  const auto   x = variables(u, 0.).first;
  expect(sqrt(x), std::sqrt(u), 0.5 / std::sqrt(u), 0.);
  expect(log(x), std::log(u), 1. / u, 0.);
  expect(exp(x), std::exp(u), std::exp(u), 0.);
  expect(sqrt(0. * x), 0., 0., 0.);
}



// f = sqrt(x y + ln(x)/y) exp(-x/y) - y/x, and its derivatives by hand.
TEST(Dual, Chained)
{
  for (const auto &[u, v] : {std::pair(1.3, 0.7), {2.9, 5.1}, {1.01, 0.2}})
    {
      const auto [x, y] = variables(u, v);
      const Number f    = sqrt(x * y + log(x) / y) * exp(-x / y) - y / x;
      const double s = std::sqrt(u * v + std::log(u) / v), e = std::exp(-u / v);
      const double s_u = 0.5 / s * (v + 1. / (u * v));
      const double s_v = 0.5 / s * (u - std::log(u) / (v * v));
      EXPECT_NEAR(f.value, s * e - v / u, 1e-14);
      EXPECT_NEAR(f.derivative[0], s_u * e - s * e / v + v / (u * u), 1e-14);
      EXPECT_NEAR(f.derivative[1],
                  s_v * e + s * e * u / (v * v) - 1. / u,
                  1e-14);
    }
}
