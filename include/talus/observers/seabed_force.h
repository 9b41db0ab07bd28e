// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_seabed_force_h
#define talus_observers_seabed_force_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

namespace talus
{
  /// Force of the seabed on the soil along x, N: mean since the last restart().
  /// The force of a single step tells little.
  template <int dim>
  class SeabedForce
  {
  public:
    /// Begin a new mean at the time of @p state. Collective.
    void
    restart(const State<dim> &state);

    /// Append the mean force, N, and the impulse since the start, N s.
    /// Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    void
    list_state(StateList &list);

  private:
    double previous_time_    = 0; // s
    double previous_impulse_ = 0; // N s
  };
} // namespace talus

#endif
