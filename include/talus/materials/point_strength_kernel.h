// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_point_strength_kernel_h
#define talus_materials_point_strength_kernel_h

#include <talus/base/always_inline.h>
#include <talus/materials/moduli.h>

#include <type_traits>

namespace talus
{
  /// Strength factor for soil whose strength differs from point to point. Flow
  /// rules and moduli then belong to material with a strength of 1 Pa.
  template <typename Number>
  struct PointStrength
  {
    Number factor;    ///< strength factor [-]
    Number strength;  ///< point strength over flow-rule strength [-]
    Number stiffness; ///< moduli of the point over the moduli of the law [-]
  };

  /// PointStrength of soil that softens with the displacement across a shear
  /// band. The flow rule then takes the softening column in place of the
  /// plastic variable.
  template <typename Number>
  struct BandStrength : PointStrength<Number>
  {
    Number rate; ///< softening per plastic variable [-]
  };

  template <typename T>
  struct IsPointStrength : std::false_type
  {};

  template <typename Number>
  struct IsPointStrength<PointStrength<Number>> : std::true_type
  {};

  template <typename Number>
  struct IsPointStrength<BandStrength<Number>> : std::true_type
  {};

  template <typename T>
  constexpr bool is_band_strength = false;

  template <typename Number>
  constexpr bool is_band_strength<BandStrength<Number>> = true;



  /// Multiplier of the strength in the flow rule [-]; @p factor is given by
  /// with_strength_factor() or with_point_strength().
  template <typename Factor>
  TALUS_ALWAYS_INLINE auto
  share_of_strength(const Factor &factor)
  {
    if constexpr (IsPointStrength<Factor>::value)
      return factor.factor * factor.strength;
    else
      return factor;
  }



  /// Multiplier [-] of further strengths given by one number in Pa, such as the
  /// residual strength.
  template <typename Factor>
  TALUS_ALWAYS_INLINE auto
  share_of_given_strength(const Factor &factor)
  {
    if constexpr (IsPointStrength<Factor>::value)
      return factor.factor;
    else
      return factor;
  }



  /// Slope per plastic variable of a quantity with the slope @p slope per
  /// softening.
  template <typename Slope, typename Factor>
  TALUS_ALWAYS_INLINE auto
  slope_of_point(const Slope &slope, [[maybe_unused]] const Factor &factor)
  {
    if constexpr (is_band_strength<Factor>)
      return slope * factor.rate;
    else
      return slope;
  }



  /// Modulus of a point, Pa.
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
