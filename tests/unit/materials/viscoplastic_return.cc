// SPDX-License-Identifier: LGPL-2.1-or-later
// The plastic shear of viscoplastic material in one step.

#include <talus/materials/viscoplastic_return_kernel.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <gtest/gtest.h>

#include <array>
#include <random>

using namespace talus;

namespace
{
  /// The plastic shear of plastic_shear() by bisection-like search in extended
  /// precision, from the equation as it stands; its logarithm is searched for.
  long double
  plastic_shear_by_search(const long double      excess,
                          const long double      loss,
                          const ShearResistance &r)
  {
    const auto f = [&](const long double log_x) {
      const long double x = std::exp(log_x);
      return r.modulus * x + loss * std::expm1(-r.decay * x) +
             r.consistency * std::exp((log_x - std::log((long double)r.dt)) *
                                      (long double)r.exponent) -
             excess;
    };
    std::uintmax_t    iterations = 2000;
    const long double upper      = std::log((excess + loss) / r.modulus) + 1.L;
    const auto        bracket    = boost::math::tools::toms748_solve(
      f,
      -2000.L,
      upper,
      boost::math::tools::eps_tolerance<long double>(60),
      iterations);
    return std::exp(0.5L * (bracket.first + bracket.second));
  }



  /// 10^x for a random x from [from, to].
  double
  magnitude(std::mt19937 &random, const double from, const double to)
  {
    return std::pow(10., from + (to - from) * (random() / 4294967295.));
  }



  constexpr unsigned int n_points = 8;
  using Values                    = std::array<double, n_points>;

  /// As many at a time as a register holds.
  Values
  plastic_shear_of_all(const Values          &excess,
                       const Values          &loss,
                       const ShearResistance &r)
  {
    Values result;
    for_each_simd(0, n_points, [&](const unsigned int i, const auto number) {
      using Number = std::decay_t<decltype(number)>;
      store(&result[i],
            plastic_shear(load<Number>(&excess[i]), load<Number>(&loss[i]), r));
    });
    return result;
  }
} // namespace



// Strengths of 1 Pa, so that all else is in units of it. Several at a time are
// those one by one, whatever the neighbours are.
TEST(ViscoplasticReturn, ReturnIsTheRoot)
{
  std::mt19937 random(7);
  double       worst = 0.;
  for (unsigned int batch = 0; batch < 2500; ++batch)
    {
      ShearResistance r{magnitude(random, -12., 12.),
                        magnitude(random, -12., 12.),
                        0.1 + 2.9 * (random() / 4294967295.),
                        0.,
                        magnitude(random, -12., 12.)};
      if (batch % 5 == 0)
        r.exponent = 1.;
      if (batch % 7 == 0)
        r.consistency = 0.;
      // Elastic and viscous resistance of the same order.
      if (batch % 3 == 0)
        r.consistency =
          magnitude(random, -3., 3.) * std::pow(r.modulus * r.dt, r.exponent);
      // loss * decay / modulus up to 0.9999.
      if (batch % 2 == 0)
        r.decay = (1. - magnitude(random, -4., 0.)) * r.modulus;
      Values excess, loss;
      for (unsigned int i = 0; i < n_points; ++i)
        {
          excess[i] = (i == 3 ? -1. : 1.) * magnitude(random, -7., 4.);
          loss[i]   = (i % 4 == 0 ? 1. : random() / 4294967295.);
        }
      const Values answer = plastic_shear_of_all(excess, loss, r);
      Values       others = excess;
      for (unsigned int i = 0; i < n_points; i += 2)
        others[i] *= 1e3;
      const Values with_others = plastic_shear_of_all(others, loss, r);
      for (unsigned int i = 0; i < n_points; ++i)
        {
          const double alone = plastic_shear<double>(excess[i], loss[i], r);
          EXPECT_NEAR(answer[i], alone, 1e-12 * alone);
          if (i % 2 == 1)
            {
              EXPECT_EQ(answer[i], with_others[i]);
            }
          if (excess[i] < 0.)
            {
              EXPECT_EQ(answer[i], 0.);
              continue;
            }
          const long double expected =
            plastic_shear_by_search(excess[i], loss[i], r);
          if (expected < 1e-290L) // below the range of double
            continue;
          const double error = std::abs(answer[i] / expected - 1.L);
          worst              = std::max(worst, error);
          ASSERT_LT(error, 1e-10)
            << "G " << r.modulus << " K " << r.consistency << " n "
            << r.exponent << " dt " << r.dt << " decay " << r.decay
            << " excess " << excess[i] << " loss " << loss[i];
        }
    }
  std::cout << "largest relative error " << worst << std::endl;
}



TEST(ViscoplasticReturn, NoTimeNoFlow)
{
  EXPECT_EQ(plastic_shear<double>(5., 0., {1., 1., 0.5, 0., 0.}), 0.);
  EXPECT_EQ(plastic_shear<double>(5., 1., {4., 1., 1., 1., 0.}), 0.);
  // Without viscosity time does not matter.
  EXPECT_EQ(plastic_shear<double>(5., 0., {4., 0., 0.5, 0., 0.}), 1.25);
}
