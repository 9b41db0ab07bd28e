// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_point_motion_h
#define talus_observers_point_motion_h

#include <talus/base/quantity.h>
#include <talus/contact/ground.h>
#include <talus/state/state.h>

namespace talus
{
  /// Smallest coordinate along @p axis of a point, m, for which the points with
  /// no larger coordinate have at least the share @p fraction [-] of the total
  /// mass. NaN without points. Collective over @p communicator.
  template <int dim>
  double
  front_of_mass(const Points<dim> &points,
                unsigned int       axis,
                double             fraction,
                MPI_Comm           communicator);



  /// Append number, extreme positions, centre of mass, velocities, mass and
  /// momentum of the points; front and rear only @p with_runout. Collective.
  template <int dim>
  void
  list_motion(const State<dim>  &state,
              const Ground<dim> &ground,
              bool               with_runout,
              Quantities        &list);
} // namespace talus

#endif
