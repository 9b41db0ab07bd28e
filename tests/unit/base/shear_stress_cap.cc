// SPDX-License-Identifier: LGPL-2.1-or-later
// The largest shear stress of a surface: a number, or of place and depth.

#include <talus/base/errors.h>
#include <talus/base/shear_stress_cap.h>

#include <gtest/gtest.h>

using namespace talus;
using dealii::Point;

namespace
{
  class ShearStressCapTest : public testing::Test
  {
  protected:
    ShearStressCapTest()
    {
      dealii::ParameterAcceptor::clear();
    }

    ShearStressCap<3>
    cap(const std::string &words)
    {
      return {"'Cap'", words, Constants()};
    }
  };
} // namespace



TEST_F(ShearStressCapTest, NumberAndPlace)
{
  EXPECT_EQ(cap("1e3").number(), 1000.);
  EXPECT_EQ(cap("1e3").at(Point<3>(1, 2, 3)), 1000.);
  EXPECT_FALSE(cap("2*500").number());
  EXPECT_FALSE(cap("x + 10*y + 100*z").depends_on_depth());
  EXPECT_EQ(cap("x + 10*y + 100*z").at(Point<3>(1, 2, 3)), 321.);
}



TEST_F(ShearStressCapTest, Depth)
{
  ShearStressCap<3> with_depth = cap("100 + 7*depth");
  EXPECT_TRUE(with_depth.depends_on_depth());
  with_depth.set_depth([](const Point<3> &x) { return 5. - x[1]; });
  EXPECT_EQ(with_depth.at(Point<3>(1, 2, 3)), 121.);
}



TEST_F(ShearStressCapTest, RefusesNegativeOnes)
{
  EXPECT_THROW(cap("-1"), ExcUser);
  EXPECT_THROW(cap("-x").at(Point<3>(1, 2, 3)), ExcUser);
  EXPECT_THROW(cap("depht"), ExcUser);
  EXPECT_THROW(cap("1/(x - 1)").at(Point<3>(1, 2, 3)), ExcPoint);
}
