// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_energy_budget_h
#define talus_observers_energy_budget_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Energy budget of the run, over all ranks; J, in 2-D J per metre width:
  ///   remainder = energies supplied - energies taken - change of energies stored,
  /// every term counted from the start of the motion. The points store kinetic
  /// energy, elastic energy and plastic work; all other terms are those of
  /// State::accounts, the work of gravity among them. The kinetic energy of the
  /// points enters the budget, so the remainder holds the energy that the
  /// transfer dissipates. A negative remainder is energy made from nothing.
  template <int dim>
  class EnergyBudget
  {
  public:
    /// Count from the present state. Collective.
    void
    begin(const State<dim> &state);

    /// Return the terms, the kinetic energy of the background grid, which is no
    /// part of the budget, and the remainder. Collective.
    Quantities
    evaluate(const State<dim> &state) const;

    /// Add the terms at the start to the state of the run.
    void
    list_state(StateList &list);

  private:
    std::vector<double> start_; ///< terms at the start, J
    bool                is_first_rank_ = false;
  };
} // namespace talus

#endif
