// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/output.h>

#include <gtest/gtest.h>

namespace
{
  using namespace talus;

  TEST(OutputTimes, FirstStepThatReachesAMultiple)
  {
    OutputTimes times;
    times.begin(0.25, 0.);
    EXPECT_FALSE(times.reached(0.));
    EXPECT_FALSE(times.reached(0.2499999999));
    EXPECT_TRUE(times.reached(0.25));
    EXPECT_FALSE(times.reached(0.25));
    EXPECT_TRUE(times.reached(0.6));
    EXPECT_FALSE(times.reached(0.7));
    // Passing several counts once.
    EXPECT_TRUE(times.reached(1.9));
    EXPECT_FALSE(times.reached(1.99));
    EXPECT_TRUE(times.reached(2.));
  }



  TEST(OutputTimes, DependOnTheTimeOnly)
  {
    // 0.1 is no binary number: quotients are rounded, the answers must agree
    // between a run and one that starts anew at any of its steps.
    const double dt = 0.0371;
    OutputTimes  run;
    run.begin(0.1, 0.);
    unsigned int n = 0;
    double       t = 0;
    for (unsigned int step = 0; step < 10000; ++step)
      {
        OutputTimes resumed;
        resumed.begin(0.1, t);
        t += dt;
        const bool due = run.reached(t);
        n += due;
        EXPECT_EQ(due, resumed.reached(t)) << "at t = " << t;
      }
    EXPECT_EQ(n, static_cast<unsigned int>(t / 0.1));
  }



  TEST(OutputTimes, NoneIsLostOnMultiples)
  {
    OutputTimes times;
    times.begin(0.1, 0.);
    for (unsigned int k = 1; k < 1000; ++k)
      EXPECT_TRUE(times.reached(k * 0.1)) << k;
  }
} // namespace
