// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/strength_reduction.h>

#include <algorithm>
#include <cmath>

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

    /// Search for the factor of soil that stands up to @p factor, if it is not
    /// reduced by more than the share @p at_once of what it stood with.
    void
    search(const double factor,
           const double largest_strength = INFINITY,
           const double at_once          = INFINITY)
    {
      begin(largest_strength);
      for (tried.clear(); !is_done() && tried.size() < 1000;)
        {
          const double most = lower() > 0. ? (1. + at_once) * lower() : 1e9;
          tried.push_back(next());
          record(tried.back(), tried.back() <= factor && tried.back() <= most);
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



  TEST(StrengthReductionTest, FindsTheFactorOfSafety)
  {
    Reduction reduction("set Tolerance = 1e-4");
    for (const double factor : {0.0123, 0.31, 0.999, 1., 1.37, 2.25, 17., 99.9})
      {
        reduction.search(factor);
        ASSERT_TRUE(reduction.is_done()) << factor;
        EXPECT_LE(reduction.lower(), factor);
        EXPECT_GT(reduction.upper(), factor);
        EXPECT_LE(reduction.upper() - reduction.lower(),
                  1e-4 * reduction.lower());
        // A bracket of half its factor, halved until it is narrow enough.
        // At last the upper end once more, if it failed from farther below.
        EXPECT_LE(reduction.tried.size(), 13u + 14u + 1u);
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
    expect_factors(reduction.tried, {2., 3., 4.5, 3.75, 4.125});
    reduction.search(1.);
    expect_factors(reduction.tried, {2., 2. / 1.5, 2. / 2.25, 10. / 9.});
  }



  // Where a trial fails because it asks for too much at once, the factor is
  // found all the same.
  TEST(StrengthReductionTest, FailureCountsOnlyFromNearby)
  {
    Reduction reduction("set Tolerance = 0.005");
    for (const double factor : {0.31, 0.999, 1., 1.37, 6.83, 17.})
      for (const double at_once : {0.3, 0.1, 0.03, 0.01, 0.006})
        {
          reduction.search(factor, INFINITY, at_once);
          ASSERT_TRUE(reduction.is_done()) << factor << ", " << at_once;
          EXPECT_LE(reduction.lower(), factor);
          EXPECT_GT(reduction.upper(), factor) << at_once;
          EXPECT_LE(reduction.upper() - reduction.lower(),
                    0.005 * reduction.lower());
        }
    // Also that of the start: it is tried again.
    reduction.begin(INFINITY);
    reduction.record(1., false);
    EXPECT_DOUBLE_EQ(reduction.next(), 1. / 1.5);
    reduction.begin(INFINITY);
    reduction.record(1. / 1.5, true);
    EXPECT_DOUBLE_EQ(reduction.next(), 1.);
  }



  // The failure that decides is not for want of small load steps.
  TEST(StrengthReductionTest, LoadStepsAreCutFartherNearby)
  {
    Reduction reduction("set Tolerance = 0.01\nset Smallest load step = 0.2");
    StaticOptions own;
    own.n_load_steps = 7;
    reduction.begin(INFINITY);
    EXPECT_EQ(reduction.options(1., own).smallest_step, 1e-3);
    EXPECT_EQ(reduction.options(1., own).n_load_steps, 7u);
    reduction.record(2., true);
    EXPECT_EQ(reduction.options(2.1, own).smallest_step, 0.2);
    EXPECT_EQ(reduction.options(2.1, own).n_load_steps, 1u);
    EXPECT_EQ(reduction.options(2.02, own).smallest_step, 1e-3);
    EXPECT_LT(reduction.options(2.1, own).max_failures,
              reduction.options(2.02, own).max_failures);

    EXPECT_DOUBLE_EQ(reduction.options(2., own).allowed_imbalance, 2e-4);
    EXPECT_EQ(Reduction("set Allowed imbalance = 3e-5")
                .options(2., own)
                .allowed_imbalance,
              3e-5);
    own.smallest_step = 0.5;
    EXPECT_EQ(reduction.options(2.02, own).smallest_step, 0.2);
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
    expect_factors(reduction.tried, {1., 1.5, 2.25, 3.375, 4.});
    EXPECT_EQ(reduction.tried.size(), 5u);
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
