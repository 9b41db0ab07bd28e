// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_contact_impulses_h
#define talus_contact_contact_impulses_h

#include <talus/contact/face_nodes.h>
#include <talus/contact/facets.h>
#include <talus/surface/place_table.h>

#include <tuple>
#include <vector>

namespace talus
{
  template <int dim>
  PlaceKey
  key_of(const ContactFacet<dim> &facet)
  {
    return place_key(facet.key, /*bed=*/facet.obstacle + 1, facet.number);
  }



  template <int dim>
  std::vector<PlaceKey>
  keys_of(const std::vector<ContactFacet<dim>> &facets)
  {
    std::vector<PlaceKey> keys;
    for (const ContactFacet<dim> &facet : facets)
      keys.push_back(key_of(facet));
    return keys;
  }



  /// Impulse of a facet, or of a node of a seabed face, on the soil in a step.
  template <int dim>
  struct ContactImpulse
  {
    double                 normal = 0;         ///< along the normal, N s, >= 0
    dealii::Tensor<1, dim> tangential;         ///< along the facet, N s
    double                 effective_mass = 0; ///< mass of soil, kg; 0: none
    double mean_normal = 0; ///< running mean of `normal`, limits friction, N s
    double area        = 0; ///< area on which soil pressed, m^(dim-1)

    bool
    acts() const
    {
      return normal > 0 || tangential.norm_square() > 0;
    }

    // Row of a PlaceTable
    static constexpr unsigned int n_keys = 4;
    static constexpr const char  *columns =
      "key of the cell or node: upper and lower 32 bits; 0 for the seabed or 1 "
      "+ obstacle; number of the facet in its cell, or face of the mesh; "
      "normal "
      "impulse [N s]; effective mass [kg]; mean normal impulse [N s]; area in "
      "contact [m or m^2]; friction impulse [N s]";

    bool
    is_kept() const
    {
      return effective_mass > 0;
    }

    auto
    values()
    {
      return std::tie(normal, effective_mass, mean_normal, area, tangential);
    }
  };



  /// Impulses of all facets in owned cells, followed by the impulses of
  /// FaceNodes. An impulse survives motion of obstacles as long as the cell has
  /// a facet of the same number.
  template <int dim>
  using ContactImpulses = PlaceTable<ContactImpulse<dim>>;
} // namespace talus

#endif
