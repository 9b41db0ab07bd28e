// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_bed_shear_h
#define talus_maps_bed_shear_h

#include <talus/contact/facet_contact.h>
#include <talus/maps/column_sums.h>

namespace talus
{
  /// Add the forces along the bed that the soil felt in the last step: from the
  /// facets of obstacles that belong to the ground, and from the bottom face of
  /// the mesh if it is a seabed (Boundaries::bed_friction()).
  template <int dim>
  void
  add_bed_shear(const State<dim>        &state,
                const FacetContact<dim> &contact,
                const Boundaries<dim>   &boundaries,
                ColumnSums<dim>         &sums);
} // namespace talus

#endif
