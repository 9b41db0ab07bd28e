// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_impact_h
#define talus_maps_impact_h

namespace talus
{
  /// The hybrid formula for what a slide does to a pipeline in its way, a part of
  /// fluid mechanics and one of soil mechanics: force per length and diameter
  /// p = 1/2 C_D rho u^2 + N_p s_u. The coefficients are the user's.
  struct ImpactFormula
  {
    double drag_coefficient = 0; ///< C_D [-]
    double bearing_factor   = 0; ///< N_p [-]

    bool
    is_used() const
    {
      return drag_coefficient != 0 || bearing_factor != 0;
    }

    /// For soil of @p density, kg/m^3, with @p speed, m/s, and operative
    /// undrained @p strength, Pa; Pa.
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
