// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_impact_h
#define talus_maps_impact_h

namespace talus
{
  /// Hybrid formula for the impact of a slide on a pipeline, the sum of a
  /// fluid-mechanics and a soil-mechanics term: force per length and diameter
  /// p = 1/2 C_D rho u^2 + N_p s_u. The user provides the coefficients.
  struct ImpactFormula
  {
    double drag_coefficient = 0; ///< C_D [-]
    double bearing_factor   = 0; ///< N_p [-]

    bool
    is_used() const
    {
      return drag_coefficient != 0 || bearing_factor != 0;
    }

    /// Return the impact pressure p, Pa.
    ///
    /// @param density of the soil, kg/m^3
    /// @param speed of the soil, m/s
    /// @param strength operative undrained shear strength, Pa
    double
    pressure(const double density,
             const double speed,
             const double strength) const
    {
      return 0.5 * drag_coefficient * density * speed * speed +
             (bearing_factor == 0 ? 0. : bearing_factor * strength);
    }
  };
} // namespace talus

#endif
