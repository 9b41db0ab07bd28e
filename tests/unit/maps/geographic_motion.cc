// SPDX-License-Identifier: LGPL-2.1-or-later
// The source of a tsunami model on longitude and latitude.

#include <talus/io/coordinate_system.h>
#include <talus/maps/geographic_motion.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using dealii::ExceptionBase;
using dealii::Point;
namespace numbers = dealii::numbers;
using namespace talus;

namespace
{
  constexpr double a = 6378137., e2 = 6.69437999014e-3; // WGS 84, m and -
  constexpr double radian = dealii::numbers::PI / 180.;

  /// Radius of curvature along the meridian, m; latitude in degrees.
  double
  radius_along(const double latitude)
  {
    const double s = std::sin(latitude * radian);
    return a * (1. - e2) / std::pow(1. - e2 * s * s, 1.5);
  }

  /// Radius of curvature across the meridian, m; latitude in degrees.
  double
  radius_across(const double latitude)
  {
    const double s = std::sin(latitude * radian);
    return a / std::sqrt(1. - e2 * s * s);
  }

  /// Northing in UTM on the central meridian: 0.9996 times the length of the
  /// meridian from the equator, m, by Simpson's rule.
  double
  northing_on_central_meridian(const double latitude)
  {
    constexpr unsigned int n   = 2000;
    double                 sum = 0;
    for (unsigned int i = 0; i <= n; ++i)
      sum += (i == 0 || i == n ? 1.
              : i % 2 == 1     ? 4.
                               : 2.) *
             radius_along(latitude * i / n);
    return 0.9996 * sum * latitude * radian / (3. * n);
  }

  /// A hill of 3 m, 400 m wide, with its top on the central meridian of UTM
  /// zone 33 at @p latitude, on cells of 50 m; twice as high in block 1.
  SurfaceMotion
  hill(const double latitude)
  {
    SurfaceMotion motion;
    Raster       &frame = motion.frame;
    frame.n_columns = frame.n_rows = 80;
    frame.dx = frame.dy = 50.;
    const double north  = northing_on_central_meridian(latitude);
    frame.west          = 5e5 - 1700.; // the top is not in the middle
    frame.south         = north - 1900.;
    motion.n_blocks     = 2;
    motion.change       = [frame, north](const unsigned int block) {
      std::vector<double> values;
      for (unsigned int j = 0; j < frame.n_rows; ++j)
        for (unsigned int i = 0; i < frame.n_columns; ++i)
          values.push_back(
            (block + 1.) * 3. *
            std::exp(-(std::pow((frame.x(i) - 5e5) / 400., 2) +
                       std::pow((frame.y(j) - north) / 400., 2))));
      return values;
    };
    return motion;
  }
} // namespace



// Where the top lies follows from the definition of UTM, heights from distances
// on the ellipsoid, which the map shortens by 0.9996. Half a cell off would
// change values by 0.16 m.
TEST(GeographicMotion, ValuesAndVolumeOfAHill)
{
  for (const double latitude : {5., 67.3})
    {
      const SurfaceMotion       motion = hill(latitude);
      const SurfaceMotion       result = on_degrees(motion, "EPSG:32633");
      const Raster             &frame  = result.frame;
      const std::vector<double> values = result.change(1);
      ASSERT_EQ(values.size(), std::size_t(frame.n_columns) * frame.n_rows);
      EXPECT_NEAR(frame.dx * radian * std::cos(latitude * radian) *
                    radius_across(latitude),
                  50.,
                  0.5);
      EXPECT_NEAR(frame.dy * radian * radius_along(latitude), 50., 0.5);
      double volume = 0, largest_error = 0;
      for (unsigned int j = 0; j < frame.n_rows; ++j)
        for (unsigned int i = 0; i < frame.n_columns; ++i)
          {
            const double value = values[std::size_t(j) * frame.n_columns + i];
            const double east  = (frame.x(i) - 15.) * radian *
                                std::cos(frame.y(j) * radian) *
                                radius_across(latitude);
            const double north =
              (frame.y(j) - latitude) * radian * radius_along(latitude);
            const double exact = 6. * std::exp(-(east * east + north * north) *
                                               std::pow(0.9996 / 400., 2));
            largest_error = std::max(largest_error, std::abs(value - exact));
            volume += value * frame.dx * frame.dy * radian * radian *
                      std::cos(frame.y(j) * radian) * radius_along(frame.y(j)) *
                      radius_across(frame.y(j));
          }
      // Linear interpolation is wrong by h^2/8 times the second derivatives.
      EXPECT_LT(largest_error, 0.06);
      EXPECT_NEAR(volume /
                    (6. * dealii::numbers::PI * std::pow(400. / 0.9996, 2)),
                  1.,
                  2e-3);
    }
}



// Fiji: 180 degrees lies in UTM zone 60 south, at the eastern edge.
TEST(GeographicMotion, AcrossTheDateLine)
{
  std::vector<Point<2>> places = {{180., -17.}};
  MapTransformation(wgs_84, "EPSG:32760").transform(places);
  SurfaceMotion motion;
  motion.frame.n_columns = motion.frame.n_rows = 10;
  motion.frame.dx = motion.frame.dy = 100.;
  motion.frame.west                 = places[0][0] - 500.;
  motion.frame.south                = places[0][1] - 500.;
  motion.n_blocks                   = 1;
  motion.change = [](unsigned int) { return std::vector<double>(100, 1.); };
  const SurfaceMotion result = on_degrees(motion, "EPSG:32760");
  EXPECT_LT(result.frame.n_columns, 16u);
  EXPECT_NEAR(std::abs(result.frame.x(result.frame.n_columns / 2)), 180., 2e-3);
  const std::vector<double> values = result.change(0);
  EXPECT_NEAR(values[values.size() / 2], 1., 1e-12);
}



TEST(GeographicMotion, UnknownMap)
{
  EXPECT_THROW(on_degrees(hill(5.), "EPSG:999999"), dealii::ExceptionBase);
}
