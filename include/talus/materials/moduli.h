// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_moduli_h
#define talus_materials_moduli_h

namespace talus
{
  /// Elastic constants of an isotropic material, Pa; of several points at once
  /// if they differ from point to point.
  template <typename Number>
  struct ModuliOf
  {
    Number lambda; ///< Lamé's first constant
    Number mu;     ///< shear modulus
    Number bulk;   ///< bulk modulus

    /// Modulus of longitudinal waves.
    Number
    longitudinal() const
    {
      return lambda + 2. * mu;
    }
  };

  using Moduli = ModuliOf<double>;
} // namespace talus

#endif
