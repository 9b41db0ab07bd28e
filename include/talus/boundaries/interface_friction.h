// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_interface_friction_h
#define talus_boundaries_interface_friction_h

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <string>

namespace talus
{
  /// Maximum friction force of soil at rest on a surface: proportional to the
  /// normal force up to a cap.
  struct CoulombLimit
  {
    double coefficient = 0; ///< Coulomb friction [-]
    double cap         = 0; ///< maximum shear stress times area, N

    /// Return the maximum friction force, N, for a normal force, N.
    double
    force(const double normal_force) const
    {
      return std::min(coefficient * normal_force, cap);
    }

    /// Whether the maximum friction force increases with the normal force, N.
    bool
    increases_at(const double normal_force) const
    {
      return coefficient * normal_force < cap;
    }
  };



  /// Friction law of a rigid surface: Coulomb friction, with a maximum shear
  /// stress on the area in contact, since soft soil cannot pass more than its
  /// remoulded strength (@cite dong2017); plus, if defined, the stress of a
  /// film of viscous mud. Nodes of a seabed on a mesh face and facets of
  /// obstacles obey the same law.
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

    /// Return the friction of soil at rest on @p area, m^(dim-1), in contact
    /// with a surface of @p maximum_shear_stress, Pa, which may be infinite.
    CoulombLimit
    limit(double maximum_shear_stress, double area) const;

    /// Force of the film, N, at a slip velocity, m/s, on an area in contact,
    /// m^(dim-1).
    double
    film_force(double slip_velocity, double area) const;

    /// Return the length of the tangential impulse in a step, N s. The film is
    /// implicit: the slip velocity u after the step satisfies
    /// mass u + dt film_force(u) = trial - dt largest_force.
    /// @param trial impulse that would stop the soil, N s
    /// @param mass effective mass of the soil at the surface, kg
    /// @param largest_force maximum friction force at rest, N
    /// @param area area in contact, m^(dim-1)
    /// @param dt time step, s
    double
    impulse(double trial,
            double mass,
            double largest_force,
            double area,
            double dt) const;

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

    double coefficient_factor_  = 1.;
    double shear_stress_factor_ = 1.;
  };
} // namespace talus

#endif
