// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_yielded_extent_h
#define talus_simulation_yielded_extent_h

#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <string>

namespace talus
{
  /// Extent in plan of a body and of its yielded soil, by columns of cells of
  /// size h: m in 2-D, m^2 in 3-D. A column counts if it holds one such point.
  struct YieldedExtent
  {
    double all      = 0.;
    double yielded  = 0.; ///< with plastic flow
    double residual = 0.; ///< with 95 % of the strength loss
  };

  /// Measure body number @p body. Collective.
  template <int dim>
  YieldedExtent
  yielded_extent(const State<dim>   &state,
                 const Problem<dim> &problem,
                 unsigned int        body);

  /// Return sentences on softening, for a search without balance: how much of
  /// each softening body has yielded in plan, by cells of size h, and over how
  /// much of softening surfaces soil has slipped. Empty if nothing has.
  /// Collective.
  template <int dim>
  std::string
  note_on_softening(const State<dim> &state, const Problem<dim> &problem);
} // namespace talus

#endif
