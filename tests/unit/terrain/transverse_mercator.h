// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_terrain_transverse_mercator_h
#define talus_tests_unit_terrain_transverse_mercator_h

#include <deal.II/base/point.h>

#include <cmath>

/// Easting and northing of longitude and latitude, degrees, in a zone of UTM
/// (WGS 84) by Krueger's series up to n^4, which leaves out 1e-7 m
/// (@cite karney2011, eqs. 7 to 12, 35): what PROJ is held against.
inline dealii::Point<2>
transverse_mercator(const dealii::Point<2> &place,
                    const unsigned int      zone,
                    const bool              is_south = false)
{
  constexpr double a = 6378137., f = 1. / 298.257223563, radian = M_PI / 180.;
  constexpr double n = f / (2. - f), n2 = n * n, n3 = n2 * n, n4 = n2 * n2;
  constexpr double alpha[] = {n / 2. - 2. / 3. * n2 + 5. / 16. * n3 +
                                41. / 180. * n4,
                              13. / 48. * n2 - 3. / 5. * n3 + 557. / 1440. * n4,
                              61. / 240. * n3 - 103. / 140. * n4,
                              49561. / 161280. * n4};
  const double     radius  = a / (1. + n) * (1. + n2 / 4. + n4 / 64.);

  const double e      = std::sqrt(f * (2. - f));
  const double sine   = std::sin(place[1] * radian);
  const double lambda = (place[0] - (6. * zone - 183.)) * radian;
  // Tangent of the conformal latitude.
  const double t   = std::sinh(std::atanh(sine) - e * std::atanh(e * sine));
  const double xi1 = std::atan2(t, std::cos(lambda));
  const double eta1 =
    std::asinh(std::sin(lambda) / std::hypot(t, std::cos(lambda)));
  double xi = xi1, eta = eta1;
  for (unsigned int j = 1; j <= 4; ++j)
    {
      xi += alpha[j - 1] * std::sin(2 * j * xi1) * std::cosh(2 * j * eta1);
      eta += alpha[j - 1] * std::cos(2 * j * xi1) * std::sinh(2 * j * eta1);
    }
  return {500000. + 0.9996 * radius * eta,
          (is_south ? 1e7 : 0.) + 0.9996 * radius * xi};
}

#endif
