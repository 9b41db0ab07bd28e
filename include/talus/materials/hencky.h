// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_hencky_h
#define talus_materials_hencky_h

#include <talus/materials/hyperelastic_law.h>

namespace talus
{
  struct HenckyEnergy;

  /// "Hencky": hyperelastic, quadratic in the logarithmic strain ln V:
  /// W = K/2 (ln J)^2 + mu dev(ln V) : dev(ln V) per undeformed volume,
  /// Kirchhoff stress tau = K ln J I + 2 mu dev(ln V) @cite simo1998, chapter
  /// 9. In 2-D the strain out of the plane is zero.
  template <int dim>
  class Hencky : public HyperelasticLaw<dim, HenckyEnergy>
  {
  public:
    Hencky(const std::string &section);

  private:
    HenckyEnergy
    strain_energy() const override;
  };
} // namespace talus

#endif
