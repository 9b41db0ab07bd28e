// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles whose velocity a function of the caller prescribes.

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "obstacles_setup.h"

using namespace talus;
using dealii::Tensor;

namespace
{
  /// A ball at rest; prescribe_velocity() and prepare() make it move.
  WithObstacles<2>
  resting_ball()
  {
    return {{"ball", "Shape = ball|Radius = 1"}};
  }
} // namespace



TEST(PrescribedVelocity, IsAskedForOncePerStepInItsMiddle)
{
  std::vector<double> times;
  WithObstacles<2>    made = resting_ball();
  Obstacles<2>       &all  = made.obstacles;
  EXPECT_FALSE(all.move());
  all.prescribe_velocity("ball", [&](const double t) {
    times.push_back(t);
    return Tensor<1, 2>({2. * t, 1.});
  });
  all.prepare(Constants());
  EXPECT_TRUE(all.move());
  EXPECT_EQ(all[0].velocity(5.).norm(), 0.);
  all.advance(1., 0.5);
  EXPECT_EQ(all[0].velocity(1.25), (Tensor<1, 2>({2.5, 1.})));
  EXPECT_EQ(all[0].velocity(9.), (Tensor<1, 2>({2.5, 1.})));
  EXPECT_EQ(all[0].displacement(), (Tensor<1, 2>({1.25, 0.5})));
  EXPECT_EQ(times, std::vector<double>{1.25});
  EXPECT_NE(all.facts().at(0).find("prescribed"), std::string::npos);
}



TEST(PrescribedVelocity, Refused)
{
  WithObstacles<2> made = resting_ball();
  Obstacles<2>    &all  = made.obstacles;
  const auto velocity = [](double) { return Tensor<1, 2>({std::nan(""), 0}); };
  EXPECT_THROW(all.prescribe_velocity("disc", velocity), ExcUser);
  all.prescribe_velocity("ball", velocity);
  all.prepare(Constants());
  EXPECT_THROW(all.advance(0., 1.), ExcUser);
}
