// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/pace.h>

#include "core_setup.h"

// The first step is not counted; up to ten later steps are counted.
TEST(Pace, MeasuresUpToTenSteps)
{
  using namespace talus;
  for (const unsigned int n_of_run : {1, 2, 7, 100})
    {
      unsigned int n_calls = 0;
      const Pace   pace =
        measure_pace([&]() { return ++n_calls < n_of_run; }, MPI_COMM_SELF);
      EXPECT_EQ(n_calls, std::min(n_of_run, 11u));
      EXPECT_EQ(pace.n_steps, n_calls - 1);
      EXPECT_EQ(pace.seconds > 0., n_calls > 1);
    }
}



TEST(Pace, UnitsOfTheEstimate)
{
  using namespace talus;
  const auto expect = [](const double seconds, const std::string &part) {
    const std::string said =
      estimate({10, seconds / 500.}, 500., 1e4, MPI_COMM_SELF);
    EXPECT_TRUE(contains(said, "about 500 time steps, which on 1 rank"))
      << said;
    EXPECT_TRUE(contains(said, " take " + part + " (")) << said;
  };
  expect(0.001, "0.1 s");
  expect(42., "42 s");
  expect(120., "2 min");
  expect(5400., "90 min");
  expect(7200., "2 h");
  expect(864000., "10 days");
  // 1e4 points in 2 ms.
  EXPECT_TRUE(contains(estimate({10, 0.002}, 500., 1e4, MPI_COMM_SELF),
                       "(5 million point-steps per second, measured in 10"));
  // Without a measurement there is no sentence on the time.
  EXPECT_TRUE(contains(estimate({0, 0.}, 1., 1e4, MPI_COMM_SELF),
                       "about 1 time step, and "));
}
