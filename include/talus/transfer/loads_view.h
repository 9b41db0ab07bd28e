// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_loads_view_h
#define talus_transfer_loads_view_h

#include <array>

namespace talus
{
  /// Loads on the points of one body, for functions of one point.
  template <int dim>
  struct LoadsView
  {
    /// Weight per mass, m/s^2.
    std::array<double, dim> weight;
    /// Additional acceleration of each point, m/s^2, by axis; null if none.
    std::array<const double *, dim> of_point;
  };
} // namespace talus

#endif
