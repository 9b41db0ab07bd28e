// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_interface_friction_h
#define talus_boundaries_interface_friction_h

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace talus
{
  /// State of a place of a surface that changes the maximum shear stress.
  struct SurfaceState
  {
    double slip         = 0;     ///< slip of soil so far, m
    bool   is_triggered = false; ///< whether the place is in the region of
                                 ///< scale_triggered_region()
  };



  /// Friction of soil on a place of a surface. At rest the force is at most
  /// proportional to the effective normal force, the normal force less that of
  /// excess pore pressure, up to a cap, which slip may reduce; a film of mud
  /// adds a viscous force on soil that slips.
  struct CoulombLimit
  {
    double coefficient = 0; ///< Coulomb friction [-]
    double cap         = 0; ///< maximum shear stress times area, N
    double pore_force  = 0; ///< excess pore pressure times area, N

    // A cap reduced by slip is min(ceiling, residual + excess e^(-rate s))
    // after a further slip s.
    double residual = 0; ///< N
    double excess   = 0; ///< N
    double rate     = 0; ///< 1/m; 0: the cap is constant
    double ceiling  = std::numeric_limits<double>::infinity(); ///< N

    // The film adds film u^n at the slip velocity u.
    double film          = 0; ///< N (s/m)^n
    double film_exponent = 1; ///< n [-]

    bool
    softens() const
    {
      return rate > 0;
    }

    /// Return the cap, N, after a further slip, m.
    double
    cap_after(const double slip) const
    {
      return softens()
               ? std::min(ceiling, residual + excess * std::exp(-rate * slip))
               : cap;
    }

    /// Return Coulomb's friction, N, for a normal force, N.
    double
    friction(const double normal_force) const
    {
      return coefficient * (pore_force == 0.
                              ? normal_force
                              : std::max(0., normal_force - pore_force));
    }

    /// Return the maximum friction force, N, for a normal force, N, after a
    /// further slip, m.
    double
    force(const double normal_force, const double slip = 0.) const
    {
      return std::min(friction(normal_force), cap_after(slip));
    }

    /// Return the derivative of force() by the slip, N/m; at most 0.
    double
    slope(const double normal_force, const double slip) const
    {
      const double lost = softens() ? excess * std::exp(-rate * slip) : 0.;
      return residual + lost < std::min(ceiling, friction(normal_force))
               ? -rate * lost
               : 0.;
    }

    /// Return the length of the tangential impulse in a step, N s. The film is
    /// implicit: the slip velocity u after the step satisfies
    /// mass u + dt film u^n = trial - dt force(normal_force). A film acts only
    /// under a normal force.
    /// @param trial impulse that would stop the soil, N s
    /// @param mass effective mass of the soil at the place, kg
    /// @param normal_force N
    /// @param dt time step, s
    double
    impulse(double trial, double mass, double normal_force, double dt) const;

    /// Whether the maximum friction force after a further slip, m, increases
    /// with the normal force, N.
    bool
    increases_at(const double normal_force, const double slip = 0.) const
    {
      return friction(normal_force) < cap_after(slip) &&
             (pore_force == 0. || normal_force > pore_force);
    }
  };



  /// Friction law of a rigid surface: Coulomb friction, with a maximum shear
  /// stress on the area in contact, since soft soil cannot pass more than its
  /// remoulded strength (@cite dong2017); plus, if defined, the stress of a
  /// film of viscous mud. Slip may take a part of the maximum shear stress
  /// away, see share_after_slip(). Nodes of a seabed on a mesh face and facets
  /// of obstacles obey the same law.
  ///
  /// Coulomb friction follows a running mean of the normal force. Otherwise a
  /// ringing elastic body has no steady sliding on a rigid surface: normal
  /// force and friction feed the waves, and the body chatters, slips by turns
  /// and is thrown up (@cite cochard2000).
  class InterfaceFriction : public dealii::ParameterAcceptor
  {
  public:
    /// @p section of the parameter file, "/Boundaries/Seabed" for example.
    explicit InterfaceFriction(const std::string &section);

    /// Check the parameters against each other, after parsing. Throws ExcUser.
    void
    check() const;

    /// Coulomb coefficient [-], including scale_strength().
    double
    coefficient() const
    {
      return coefficient_factor_ * coefficient_;
    }

    /// Set the multiplier @p factor [-] of maximum shear stresses.
    void
    scale_shear_stress(const double factor)
    {
      shear_stress_factor_ = factor;
    }

    /// Set the multiplier @p factor [-] of maximum shear stresses and of the
    /// coefficient. The film is no strength and stays unchanged.
    void
    scale_strength(const double factor)
    {
      shear_stress_factor_ = coefficient_factor_ = factor;
    }

    /// Set the fraction @p factor [-] of maximum shear stresses to which the
    /// trigger brings the places of its region, unless slip took more.
    void
    scale_triggered_region(const double factor)
    {
      region_factor_ = factor;
    }

    /// Whether slip takes a part of the maximum shear stress away.
    bool
    softens() const
    {
      return slip_to_remould_ > 0;
    }

    /// Whether a rule of limit() depends on the slip of the place.
    bool
    changes_by_slip() const
    {
      return softens();
    }

    /// Share of the maximum shear stress left after a slip, m [-]:
    /// r + (1 - r) exp(-3 s/s_95) @cite einav2005.
    double
    share_after_slip(double slip) const;

    /// Share of the maximum shear stress left at a place [-], by slip and
    /// trigger; without scale_shear_stress() and scale_strength().
    double
    share_left(const SurfaceState &state) const;

    /// Return the friction of soil on @p area, m^(dim-1), in contact with a
    /// place of the surface. All rules by which a place changes belong here.
    /// @param maximum_shear_stress of intact soil, Pa, which may be infinite
    /// @param area in contact, m^(dim-1)
    /// @param state of the place
    CoulombLimit
    limit(double              maximum_shear_stress,
          double              area,
          const SurfaceState &state = {}) const;

    /// Weight of the current normal force in the running mean [-], for a slip
    /// of @p slip, m, in the step and cells of @p cell_size, m. The memory of
    /// the mean is 32 steps, and 0.05 cells of slip.
    static double
    averaging_weight(double slip, double cell_size);

  private:
    // Parameters
    double coefficient_      = 10.;
    double film_consistency_ = 0.;
    double film_exponent_    = 1.;
    double film_thickness_   = 0.;
    double slip_to_remould_  = 0.;
    double remoulded_ratio_  = 1.;

    double coefficient_factor_  = 1.;
    double shear_stress_factor_ = 1.;
    double region_factor_       = 1.;
  };
} // namespace talus

#endif
