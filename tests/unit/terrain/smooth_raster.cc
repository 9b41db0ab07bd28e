// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/terrain/project_raster.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
  /// Cells of 0.5 m x 1 m with values f(x, y).
  template <typename Function>
  talus::Raster
  raster(const Function &f)
  {
    talus::Raster result;
    result.n_columns = 60;
    result.n_rows    = 20;
    result.dx        = 0.5;
    for (unsigned int r = 0; r < result.n_rows; ++r)
      for (unsigned int c = 0; c < result.n_columns; ++c)
        result.values.push_back(f(result.x(c), result.y(r)));
    return result;
  }
} // namespace



TEST(SmoothRaster, PlaneIsKeptAlsoAroundAHole)
{
  const auto plane = raster([](const double x, const double y) {
    return x == 10.25 && y == 7.5 ? std::nan("") : 3. + 0.2 * x - 0.7 * y;
  });
  auto       other = plane;
  talus::smooth(other, 4.);
  EXPECT_EQ(other.smoothed_over, 4.);
  for (std::size_t i = 0; i < plane.values.size(); ++i)
    if (std::isnan(plane.values[i]))
      EXPECT_TRUE(std::isnan(other.values[i]));
    else
      EXPECT_NEAR(other.values[i], plane.values[i], 1e-12);
}



// The mean of a wave of length L over the width w is sin(pi w/L)/(pi w/L), for
// n values sin(n pi/N)/(n sin(pi/N)), with N = L/dx.
TEST(SmoothRaster, WavesShorterThanTheCellsVanish)
{
  constexpr double pi    = 3.14159265358979323846;
  const auto       waves = raster(
    [](const double x, const double) { return std::sin(2. * pi * x / 3.); });
  auto other = waves;
  talus::smooth(other, 2.);
  const double share = std::sin(5. * pi / 6.) / (5. * std::sin(pi / 6.));
  for (unsigned int c = 2; c < 58; ++c)
    EXPECT_NEAR(other.value(c, 9), share * waves.value(c, 9), 1e-12);
  other = waves;
  talus::smooth(other, 0.9);
  EXPECT_EQ(other.values, waves.values);
  EXPECT_EQ(other.smoothed_over, 0.);
}
