// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_footprint_h
#define talus_observers_footprint_h

#include <talus/base/quantity.h>
#include <talus/contact/contact.h>
#include <talus/state/state.h>

namespace talus
{
  /// Append two areas of the last step, m^(dim-1): the area of ground in
  /// contact with soil, and the area of ground under the boxes of the points,
  /// counted on columns a quarter of a cell wide. The areas differ where soil
  /// is in the air, or where contact misses soil lying on the ground. Without
  /// seabed and obstacles both areas are 0. Collective.
  template <int dim>
  void
  list_contact_area(const State<dim>      &state,
                    const Boundaries<dim> &boundaries,
                    const Contact<dim>    &contact,
                    Quantities            &row);
} // namespace talus

#endif
