// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_yielded_extent_h
#define talus_simulation_yielded_extent_h

#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <string>

namespace talus
{
  /// Return sentences on softening, for a search without balance: how much of
  /// each softening body has yielded in plan, by cells of size h, and over how
  /// much of softening surfaces soil has slipped. Empty if nothing has.
  /// Collective.
  template <int dim>
  std::string
  note_on_softening(const State<dim> &state, const Problem<dim> &problem);
} // namespace talus

#endif
