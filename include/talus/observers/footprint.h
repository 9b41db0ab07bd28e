// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_footprint_h
#define talus_observers_footprint_h

#include <talus/base/quantity.h>
#include <talus/contact/facet_contact.h>
#include <talus/state/state.h>

namespace talus
{
  /// Append the area in which soil touches the ground and the area of the ground
  /// that lies under the boxes of the points, m^(dim-1), both for the last step.
  /// They differ where soil is in the air, or where contact misses soil that lies
  /// on the ground. The second one is found on columns of a quarter of a cell.
  /// Both are 0 without seabed and obstacles. Collective.
  template <int dim>
  void
  list_contact_area(const State<dim>        &state,
                    const Boundaries<dim>   &boundaries,
                    const FacetContact<dim> &contact,
                    Quantities              &row);
} // namespace talus

#endif
