// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_energy_budget_h
#define talus_observers_energy_budget_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

namespace talus
{
  /// Where the energy is and where it went, over all ranks; J, in 2-D J per
  /// metre width.
  struct EnergyTerms
  {
    double kinetic      = 0; ///< of the points, velocities at the half step
    double grid_kinetic = 0; ///< of the background grid
    double elastic      = 0;
    double plastic      = 0; ///< plastic work so far
    double friction     = 0; ///< taken by friction so far
    /// Taken by normal contact, walls and tractions so far; negative where
    /// these drive the soil.
    double contact = 0;
    double damping = 0; ///< taken by local damping so far
    double drag    = 0; ///< taken by the drag of water so far
    double added   = 0; ///< kinetic energy of the added mass of water
    double merging = 0; ///< taken by merging points so far
    double outflow = 0; ///< taken along by points that left the mesh so far
    double gravity = 0; ///< work of weight and body forces so far
    /// What the other terms leave of the gravity work since the start;
    /// positive if energy was lost, negative if some was created.
    double remainder = 0;
  };



  /// The energy budget
  ///   remainder = gravity work - change of kinetic energy - change of elastic
  ///   energy - plastic work - friction work - contact work - damping work - drag
  ///   work - merging work - outflow energy,
  /// every term counted from the start. It is the points' kinetic energy that
  /// enters, with that of the water that moves with them, so the remainder
  /// holds what the transfer dissipates.
  template <int dim>
  class EnergyBudget
  {
  public:
    /// Count from here.
    void
    begin(const State<dim> &state);

    /// The terms now; collective over the ranks of the grid.
    EnergyTerms
    evaluate(const State<dim> &state) const;

    /// List the terms. Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    /// Add the terms at the start to the state of the run.
    void
    list_state(StateList &list);

  private:
    EnergyTerms start_;
  };
} // namespace talus

#endif
