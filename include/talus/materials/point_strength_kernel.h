// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_point_strength_kernel_h
#define talus_materials_point_strength_kernel_h

#include <talus/base/always_inline.h>
#include <talus/materials/moduli.h>

#include <type_traits>

namespace talus
{
  /// What takes the place of the strength factor where soil has another strength
  /// at each point: there flow rules and moduli are those of material with a
  /// strength of 1 Pa.
  template <typename Number>
  struct PointStrength
  {
    Number factor;    ///< strength factor [-]
    Number strength;  ///< of the point over that of the flow rule [-]
    Number stiffness; ///< the same of the moduli [-]
  };

  template <typename T>
  struct IsPointStrength : std::false_type
  {};

  template <typename Number>
  struct IsPointStrength<PointStrength<Number>> : std::true_type
  {};



  /// What the flow rule's strength is multiplied with, given what
  /// with_strength_factor() gives.
  template <typename Factor>
  TALUS_ALWAYS_INLINE auto
  share_of_strength(const Factor &factor)
  {
    if constexpr (IsPointStrength<Factor>::value)
      return factor.factor * factor.strength;
    else
      return factor;
  }



  /// What the user gave in Pa, but is a part of the strength, is multiplied
  /// with.
  template <typename Factor>
  TALUS_ALWAYS_INLINE auto
  share_of_given_strength(const Factor &factor)
  {
    if constexpr (IsPointStrength<Factor>::value)
      return factor.factor;
    else
      return factor;
  }



  /// The modulus of a point.
  template <typename Factor>
  TALUS_ALWAYS_INLINE auto
  modulus_of_point(const double modulus, [[maybe_unused]] const Factor &factor)
  {
    if constexpr (IsPointStrength<Factor>::value)
      return modulus * factor.stiffness;
    else
      return modulus;
  }



  template <typename Factor>
  TALUS_ALWAYS_INLINE auto
  moduli_of_point(const Moduli &moduli, const Factor &factor)
  {
    using Number = decltype(modulus_of_point(moduli.mu, factor));
    return ModuliOf<Number>{modulus_of_point(moduli.lambda, factor),
                            modulus_of_point(moduli.mu, factor),
                            modulus_of_point(moduli.bulk, factor)};
  }
} // namespace talus

#endif
