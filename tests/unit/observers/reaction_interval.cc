// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/reaction_table.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  using namespace talus;

  constexpr double averaging_time = 0.1; // s

  /// Add @p n steps of @p dt seconds with the force @p force along x, N.
  void
  add_steps(ReactionInterval<2> &interval,
            const unsigned int   n,
            const double         dt,
            const double         force)
  {
    StepReaction<2> step;
    step.impulse[0] = force * dt;
    for (unsigned int i = 0; i < n; ++i)
      interval.add(step, dt, averaging_time);
  }
} // namespace



// A force that is there from the first step on is its own mean.
TEST(ReactionInterval, MeanOfAConstantForce)
{
  ReactionInterval<2> interval;
  add_steps(interval, 50, 0.003, 7.);
  EXPECT_NEAR(interval.min_mean()[0], 7., 1e-13);
  EXPECT_NEAR(interval.max_mean()[0], 7., 1e-13);
}



// After a force F ends, its mean falls as F exp(-t/T), however the time is
// divided into steps.
TEST(ReactionInterval, MeanDecays)
{
  for (const unsigned int n : {1u, 10u, 1000u})
    {
      ReactionInterval<2> interval;
      add_steps(interval, 1, 0.01, 5.);
      add_steps(interval, n, 0.23 / n, 0.);
      EXPECT_NEAR(interval.running_mean()[0],
                  5. * std::exp(-0.23 / averaging_time),
                  1e-13);
    }
}



// An impact of one step counts by its impulse over T, and not by the length of
// the step, by which the extreme of a step counts.
TEST(ReactionInterval, ImpactsAreAveraged)
{
  ReactionInterval<2> interval;
  add_steps(interval, 1, 1e-3, 0.);
  add_steps(interval, 1, 1e-5, 1e6); // 10 N s
  EXPECT_NEAR(interval.max()[0], 1e6, 1e-6);
  EXPECT_NEAR(interval.max_mean()[0], 10. / averaging_time, 1e-2);
}



// Extremes are those of the interval, in which the mean goes on.
TEST(ReactionInterval, MeanGoesOnFromIntervalToInterval)
{
  ReactionInterval<2> interval;
  add_steps(interval, 1, 0.01, 5.);
  interval.restart();
  add_steps(interval, 2, 0.05, 0.);
  EXPECT_NEAR(interval.max_mean()[0], 5. * std::exp(-0.5), 1e-13);
  EXPECT_NEAR(interval.min_mean()[0], 5. * std::exp(-1.), 1e-13);
  EXPECT_EQ(interval.max()[0], 0.);
}
