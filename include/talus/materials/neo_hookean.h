// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_neo_hookean_h
#define talus_materials_neo_hookean_h

#include <talus/materials/hyperelastic_law.h>

namespace talus
{
  struct NeoHookeanEnergy;

  /// "neo-Hookean": hyperelastic, sigma = [lambda ln J I + mu (F F^T - I)]/J,
  /// W = mu/2 (tr(F F^T) - 3 - 2 ln J) + lambda/2 (ln J)^2 per undeformed
  /// volume @cite bonet2008, section 6.4. In 2-D the strain out of the plane is
  /// zero.
  template <int dim>
  class NeoHookean : public HyperelasticLaw<dim, NeoHookeanEnergy>
  {
  public:
    NeoHookean(const std::string &section);

  private:
    NeoHookeanEnergy
    strain_energy() const override;
  };
} // namespace talus

#endif
