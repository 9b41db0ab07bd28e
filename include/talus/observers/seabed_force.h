// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_seabed_force_h
#define talus_observers_seabed_force_h

#include <talus/base/quantity.h>
#include <talus/state/state.h>

namespace talus
{
  /// The force of the seabed on the soil along x: its mean since the time
  /// before, since that of a single step tells little.
  template <int dim>
  class SeabedForce
  {
  public:
    /// The time from which the next mean is taken. Collective.
    void
    restart(const State<dim> &state);

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
