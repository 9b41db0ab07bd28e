// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_driven_h
#define talus_tests_cases_driven_h

#include "case.h"

#include <algorithm>
#include <cmath>

namespace talus::cases
{
  /// The stress of a point, Pa.
  struct StressOf
  {
    double xx, yy, zz, xy;

    StressOf(const Points<2> &points, const unsigned int p)
      : xx(points.data(points.stress, 0)[p])
      , yy(points.data(points.stress, 1)[p])
      , zz(points.data(points.stress, 2)[p])
      , xy(points.data(points.stress, 3)[p])
    {}

    double
    distance(const double x,
             const double y,
             const double z,
             const double s) const
    {
      return std::max({std::abs(xx - x),
                       std::abs(yy - y),
                       std::abs(zz - z),
                       std::abs(xy - s)});
    }
  };



  template <typename Action>
  void
  for_points(Case<2> &simulation, const Action &action)
  {
    for (unsigned int p = 0; p < simulation.points().size(); ++p)
      action(p);
  }



  inline void
  advance_to(Case<2> &simulation, const double time)
  {
    while (simulation->state().time < time - 1e-12)
      simulation->advance();
  }



  /// One column of a point.
  inline double
  value(Case<2> &simulation, const unsigned int column, const unsigned int p)
  {
    return simulation.points().data(column)[p];
  }
} // namespace talus::cases

#endif
