// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_impulses_h
#define talus_contact_facet_impulses_h

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
    return place_key(facet.key, facet.obstacle, facet.number);
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



  /// Impulse of a facet on the soil in a step.
  template <int dim>
  struct FacetImpulse
  {
    double                 normal = 0;         ///< along the normal, N s, >= 0
    dealii::Tensor<1, dim> tangential;         ///< along the facet, N s
    double                 effective_mass = 0; ///< mass of soil, kg; 0: none
    double mean_normal = 0; ///< running mean of `normal`, limits friction, N s

    bool
    acts() const
    {
      return normal > 0 || tangential.norm_square() > 0;
    }

    // Row of a PlaceTable
    static constexpr unsigned int n_keys = 4;
    static constexpr const char  *columns =
      "key of the cell: upper and lower 32 bits; obstacle; number of the facet "
      "in its cell; normal impulse [N s]; effective mass [kg]; mean normal "
      "impulse [N s]; friction impulse [N s]";

    bool
    is_kept() const
    {
      return effective_mass > 0;
    }

    auto
    values()
    {
      return std::tie(normal, effective_mass, mean_normal, tangential);
    }
  };



  /// Impulses of all facets in owned cells. An impulse survives motion of
  /// obstacles as long as the cell has a facet of the same number.
  template <int dim>
  using FacetImpulses = PlaceTable<FacetImpulse<dim>>;
} // namespace talus

#endif
