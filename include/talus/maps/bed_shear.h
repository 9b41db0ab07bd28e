// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_bed_shear_h
#define talus_maps_bed_shear_h

#include <talus/contact/facet_contact.h>
#include <talus/maps/column_sums.h>

namespace talus
{
  /// Add the forces of the last step along the bed, N, acting on the soil: from
  /// the facets of obstacles belonging to the ground, and from the bottom face
  /// of the mesh if it is a seabed (see Boundaries::bed_friction()).
  ///
  /// @param state of the run
  /// @param contact facets of the obstacles
  /// @param boundaries faces of the mesh
  /// @param sums receives the forces by column
  template <int dim>
  void
  add_bed_shear(const State<dim>        &state,
                const FacetContact<dim> &contact,
                const Boundaries<dim>   &boundaries,
                ColumnSums<dim>         &sums);
} // namespace talus

#endif
