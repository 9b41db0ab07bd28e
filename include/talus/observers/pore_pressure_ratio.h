// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_pore_pressure_ratio_h
#define talus_observers_pore_pressure_ratio_h

#include <talus/points/points.h>
#include <talus/points/points_kernel.h>

#include <algorithm>
#include <vector>

namespace talus
{
  /// Return the pore pressure ratio r_u at each point [-]: the excess pore
  /// pressure over the overburden at rest. Both are means over the cell, as the
  /// water of undrained soil answers to the volume of the cell. 0 without
  /// weight, and at points that are not sorted.
  template <int dim>
  inline std::vector<double>
  pore_pressure_ratio(const Points<dim> &points)
  {
    std::vector<double> result(points.size(), 0.);
    points.for_each_cell(points.all(), [&](const Batch &cell) {
      double u = 0, weight = 0; // times volume
      for (unsigned int p = cell.begin; p < cell.end; ++p)
        {
          const double V = volume_of_points<dim, double>(points, p);
          u += V * points.data(points.pore_pressure())[p];
          weight += V * points.data(points.overburden())[p];
        }
      if (weight > 0.)
        std::fill_n(&result[cell.begin], cell.end - cell.begin, u / weight);
    });
    return result;
  }
} // namespace talus

#endif
