// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_moduli_h
#define talus_materials_moduli_h

namespace talus
{
  /// Elastic constants of an isotropic material, Pa.
  struct Moduli
  {
    double lambda; ///< Lamé's first constant
    double mu;     ///< shear modulus
    double bulk;   ///< bulk modulus

    /// Of a longitudinal wave.
    double
    longitudinal() const
    {
      return lambda + 2. * mu;
    }
  };
} // namespace talus

#endif
