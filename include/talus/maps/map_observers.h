// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_map_observers_h
#define talus_maps_map_observers_h

#include <talus/observers/output.h>
#include <talus/problem/problem.h>

namespace talus
{
  /// Add the plan-view observers (maps, stations, lines, runout, series) to
  /// @p output, and declare the sections Maps, Stations and Runout. @p problem
  /// must outlive @p output.
  template <int dim>
  void
  add_map_observers(Problem<dim> &problem, Output<dim> &output);
} // namespace talus

#endif
