// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/strength_reduction.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core_setup.h"

namespace
{
  using namespace talus;

  struct Reduction : FreshParameters, StrengthReduction
  {
    explicit Reduction(const std::string &entries = "")
    {
      auto &prm = dealii::ParameterAcceptor::prm;
      dealii::ParameterAcceptor::declare_all_parameters();
      prm.parse_input_from_string(in_section("Strength reduction", entries));
      dealii::ParameterAcceptor::parse_all_parameters();
    }

    /// Search for the factor of soil that fails above @p factor, where nothing
    /// moves before.
    void
    search(const double factor, const double largest_strength = INFINITY)
    {
      begin(largest_strength);
      for (tried.clear(); lower() == 0. && !is_done();)
        {
          tried.push_back(next());
          record(tried.back(), tried.back() <= factor);
        }
      while (lower() > 0. && !is_done() && tried.size() < 1000)
        {
          tried.push_back(path().factor + path().change);
          const bool is_found = (tried.back() <= factor);
          if (is_found)
            path().factor = tried.back();
          record_step(is_found, 1);
        }
    }

    /// Follow the path of soil that moves by s with the factor @p curve (s),
    /// which grows up to the displacement 1 at least. Steps longer than
    /// @p longest fail.
    void
    follow(const std::function<double(double)> &curve, const double longest)
    {
      const auto displacement = [&](const double factor) {
        double s = 0.;
        while (s < 1. && curve(s) < factor)
          s += 1e-4;
        return s;
      };
      begin(INFINITY);
      record(curve(0.), true);
      for (tried.clear(); !is_done() && tried.size() < 10000;)
        {
          StrengthPath &next   = path();
          const double  before = next.displacement;
          const double  after  = next.by_factor
                                   ? displacement(next.factor + next.change)
                                   : before + next.length;
          tried.push_back(next.by_factor ? next.factor + next.change : 0.);
          const bool is_found =
            after - before <= longest && !(next.by_factor && after >= 1.);
          if (is_found)
            {
              next.factor       = curve(after);
              next.displacement = after;
              next.length       = after - before;
              next.direction    = {1.};
            }
          record_step(is_found, 5);
        }
    }

    std::vector<double> tried;
  };



  void
  expect_factors(const std::vector<double> &found,
                 const std::vector<double> &expected)
  {
    ASSERT_GE(found.size(), expected.size());
    for (unsigned int i = 0; i < expected.size(); ++i)
      EXPECT_DOUBLE_EQ(found[i], expected[i]);
  }



  TEST(StrengthReductionTest, FindsTheFactorOfSoilThatFailsAtOnce)
  {
    Reduction reduction("set Tolerance = 1e-4");
    for (const double factor : {0.0123, 0.31, 0.999, 1., 1.37, 2.25, 17., 99.9})
      {
        reduction.search(factor);
        ASSERT_TRUE(reduction.is_done()) << factor;
        EXPECT_LE(reduction.lower(), factor);
        EXPECT_GT(reduction.upper(), factor);
        EXPECT_LE(reduction.upper() - reduction.lower(),
                  1.01e-4 * reduction.lower());
        // Downwards, upwards, and a bracket of a quarter halved until it is
        // narrow enough.
        EXPECT_LE(reduction.tried.size(), 13u + 20u + 14u);
        EXPECT_TRUE(contains(reduction.result(),
                             text(std::setprecision(6),
                                  "The factor of safety is ",
                                  0.5 * (reduction.lower() + reduction.upper()),
                                  ": the soil stands with its strength divided "
                                  "by ",
                                  reduction.lower(),
                                  " and fails with ",
                                  reduction.upper())));
      }
  }



  TEST(StrengthReductionTest, FactorsTried)
  {
    Reduction reduction("set First factor = 2");
    reduction.search(4.);
    expect_factors(reduction.tried, {2., 2.2, 2.6, 3.25, 4.0625, 3.65625});
    reduction.search(1.);
    expect_factors(reduction.tried, {2., 2. / 1.5, 2. / 2.25});
    // Soil that stands already goes towards the first factor.
    reduction.begin(INFINITY);
    reduction.record(1.8, true);
    EXPECT_DOUBLE_EQ(reduction.path().change, 0.2);
  }



  TEST(StrengthReductionTest, FindsTheLimitOfThePath)
  {
    // A limit approached fast or slowly. Where the distance from the limit
    // falls as 1/s, it is at most 1/ln 2 times the change by a doubling.
    for (const double tolerance : {0.01, 1e-3, 1e-4})
      for (const double longest : {1e9, 0.5, 0.1})
        for (const double limit : {0.37, 1.44})
          for (const bool fast : {true, false})
            {
              Reduction reduction(text("set Tolerance = ", tolerance));
              reduction.follow(
                [&](const double s) {
                  return limit * (fast ? 1. - 0.3 * std::exp(-5. * s)
                                       : 1. - 0.3 / (1. + 5. * s));
                },
                fast ? longest : std::max(longest, 0.5));
              ASSERT_TRUE(reduction.is_done());
              EXPECT_LE(reduction.factor(), limit);
              EXPECT_NEAR(reduction.factor(), limit, 1.45 * tolerance * limit)
                << tolerance << ", " << longest << ", " << fast;
              if (longest > 1.)
                EXPECT_TRUE(
                  contains(reduction.result(), "moves on with its strength"));
              EXPECT_EQ(reduction.is_less_than_one(), limit < 1.);
            }
  }



  // The largest factor counts, also where the path falls again.
  TEST(StrengthReductionTest, LimitOfSofteningSoil)
  {
    Reduction reduction;
    reduction.follow(
      [](const double s) { return 1.5 - 0.5 * (s - 1.) * (s - 1.); }, 0.1);
    ASSERT_TRUE(reduction.is_done());
    EXPECT_NEAR(reduction.factor(), 1.5, 1.5e-3);
    EXPECT_LT(reduction.path().factor, 1.5);
  }



  // Where no step of given length is found, factors are tried.
  TEST(StrengthReductionTest, FactorsDecideWhereNoLengthIsFound)
  {
    Reduction reduction;
    reduction.begin(INFINITY);
    reduction.record(1., true);
    unsigned int n = 0;
    for (; !reduction.is_done() && n < 1000; ++n)
      {
        StrengthPath &next     = reduction.path();
        const double  factor   = next.factor + next.change;
        const bool    is_found = next.by_factor && factor <= 1.2345;
        if (is_found)
          {
            next.factor    = factor;
            next.direction = {1.};
          }
        reduction.record_step(is_found, 9);
      }
    EXPECT_LT(n, 60u);
    EXPECT_LE(reduction.lower(), 1.2345);
    EXPECT_GT(reduction.upper(), 1.2345);
    EXPECT_LE(reduction.upper(), 1.00101 * reduction.lower());
  }



  TEST(StrengthReductionTest, StandingSoilTakesTheChangeInOneStep)
  {
    Reduction     reduction("set Tolerance = 0.01");
    StaticOptions own;
    own.n_load_steps = 7;
    reduction.begin(INFINITY);
    EXPECT_EQ(reduction.options(own).n_load_steps, 7u);
    reduction.record(2., true);
    EXPECT_EQ(reduction.options(own).n_load_steps, 1u);
    EXPECT_DOUBLE_EQ(reduction.options(own).allowed_imbalance, 1e-3);
    EXPECT_EQ(
      Reduction("set Allowed imbalance = 3e-5").options(own).allowed_imbalance,
      3e-5);
  }



  TEST(StrengthReductionTest, LessThanOneIsSaid)
  {
    Reduction reduction;
    for (const double factor : {0.3, 0.99})
      {
        reduction.search(factor);
        EXPECT_TRUE(reduction.is_less_than_one());
        EXPECT_TRUE(contains(reduction.result(), "It is less than 1"));
      }
    for (const double factor : {1., 1.01, 3.})
      {
        reduction.search(factor);
        EXPECT_FALSE(reduction.is_less_than_one());
        EXPECT_FALSE(contains(reduction.result(), "less than 1"));
      }
  }



  // Soil that softens gets no more strength than it may have.
  TEST(StrengthReductionTest, StrengthIsIncreasedToItsLimitOnly)
  {
    Reduction reduction("set Smallest factor = 0.1");
    reduction.search(0.3, /*largest_strength=*/2.);
    expect_factors(reduction.tried, {1., 1. / 1.5, 0.5});
    EXPECT_EQ(reduction.tried.size(), 3u);
    EXPECT_TRUE(reduction.is_done());
    EXPECT_EQ(reduction.lower(), 0.);
    EXPECT_TRUE(contains(reduction.result(),
                         "less than 0.5; stronger soil would soften faster"));
    reduction.search(0.55, 2.);
    EXPECT_LE(reduction.lower(), 0.55);
    EXPECT_GT(reduction.upper(), 0.55);
    EXPECT_GE(*std::min_element(reduction.tried.begin(), reduction.tried.end()),
              0.5);
  }



  TEST(StrengthReductionTest, EndsAtTheLimits)
  {
    Reduction reduction("set Largest factor = 4\nset Smallest factor = 0.2");
    reduction.search(1e9);
    expect_factors(reduction.tried, {1., 1.1, 1.3, 1.625, 2.03125});
    EXPECT_EQ(reduction.tried.back(), 4.);
    EXPECT_EQ(reduction.lower(), 4.);
    EXPECT_EQ(reduction.upper(), 0.);
    EXPECT_TRUE(contains(reduction.result(),
                         "is more than 4, where 'Strength "
                         "reduction/Largest factor' ends"));
    reduction.search(0.);
    EXPECT_EQ(reduction.lower(), 0.);
    EXPECT_EQ(reduction.upper(), 0.2);
    EXPECT_EQ(reduction.tried.back(), 0.2);
    EXPECT_TRUE(contains(reduction.result(),
                         "is less than 0.2, where 'Strength "
                         "reduction/Smallest factor' "
                         "ends"));
    // What is between the last but one and the limit is found.
    reduction.search(3.9);
    EXPECT_TRUE(reduction.lower() <= 3.9 && reduction.upper() > 3.9);
    reduction.search(0.21);
    EXPECT_TRUE(reduction.lower() <= 0.21 && reduction.upper() > 0.21);
  }
} // namespace
