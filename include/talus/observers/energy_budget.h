// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_energy_budget_h
#define talus_observers_energy_budget_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Energy budget of the run over all ranks, J; in 2-D J per metre width:
  ///   remainder = energy supplied - energy taken - change of energy stored.
  /// Every term counts from the start of the motion. The points store kinetic
  /// energy, elastic energy and plastic work; State::accounts has all other
  /// terms, such as the work of gravity. The budget uses the kinetic energy of
  /// the points, so the remainder contains the dissipation of the transfer. A
  /// negative remainder is energy made from nothing.
  template <int dim>
  class EnergyBudget
  {
  public:
    /// Begin the budget at @p state. Collective.
    void
    begin(const State<dim> &state);

    /// Return the terms, the kinetic energy of the background grid (no part of
    /// the budget), and the remainder. Collective.
    Quantities
    evaluate(const State<dim> &state) const;

    /// Add the terms at the start to the state of the run.
    void
    list_state(StateList &list);

  private:
    std::vector<double> start_; ///< terms at the start, J
  };
} // namespace talus

#endif
