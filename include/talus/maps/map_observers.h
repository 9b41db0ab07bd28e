// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_map_observers_h
#define talus_maps_map_observers_h

#include <talus/observers/output.h>
#include <talus/problem/problem.h>

namespace talus
{
  /// Add to @p output what looks at the plan: maps, stations, and lines; declares
  /// the sections Maps and Stations. @p problem must outlive it.
  template <int dim>
  void
  add_map_observers(Problem<dim> &problem, Output<dim> &output);
} // namespace talus

#endif
