// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/points.h>

#include <gtest/gtest.h>

namespace
{
  using namespace talus;

  /// As splits do it. All columns grow, and keep what they hold.
  TEST(Points, GrowLittleByLittle)
  {
    Points<2>          points;
    const unsigned int strain =
      points.add_column("plastic strain", "-", 1, Inheritance::copied);
    for (unsigned int n = 0; n < 20000; ++n)
      {
        const unsigned int p = points.append(1);
        ASSERT_EQ(p, n);
        points.data(points.position)[p] = n;
        EXPECT_EQ(points.data(strain)[p], 0.) << "appended points are zero";
        points.data(strain)[p] = 2. * n;
        // The arrays with some room to grow, and what a step works with.
        if (n == 1000 || n == 4321 || n == 19999)
          {
            EXPECT_LE(points.memory_consumption(), 400. * points.size());
            EXPECT_GE(points.memory_consumption(),
                      sizeof(double) * points.n_arrays() * points.size());
          }
      }
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        ASSERT_EQ(points.data(points.position)[p], p);
        ASSERT_EQ(points.data(strain)[p], 2. * p);
      }
  }
} // namespace
