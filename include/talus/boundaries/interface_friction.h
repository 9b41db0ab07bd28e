// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_interface_friction_h
#define talus_boundaries_interface_friction_h

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <string>

namespace talus
{
  /// Shear that a rigid surface passes to soil which slides along it: Coulomb
  /// friction, capped per area in contact as soft soil cannot pass more than its
  /// own remoulded strength (@cite dong2017), plus, where a film of viscous mud
  /// is asked for, the stress of that film. Nodes of a seabed on a mesh face and
  /// facets of obstacles obey the same law.
  ///
  /// Coulomb friction is limited by a running mean of the normal force. On a
  /// rigid surface an elastic body that rings has no steady sliding otherwise:
  /// normal force and friction feed the waves, and the body chatters, slips by
  /// turns and is thrown up (@cite cochard2000).
  class InterfaceFriction : public dealii::ParameterAcceptor
  {
  public:
    /// @p section of the parameter file, "/Boundaries/Seabed" for example.
    explicit InterfaceFriction(const std::string &section);

    /// Check the parameters against each other, after parsing. Throws ExcUser.
    void
    check() const;

    /// Coulomb coefficient as a strength reduction leaves it [-].
    double
    coefficient() const
    {
      return coefficient_factor_ * coefficient_;
    }

    /// Multiply maximum shear stresses by @p factor from now on [-].
    void
    scale_shear_stress(const double factor)
    {
      shear_stress_factor_ = factor;
    }

    /// Multiply maximum shear stresses and the coefficient by @p factor from now
    /// on [-]. The film is no strength and stays.
    void
    scale_strength(const double factor)
    {
      shear_stress_factor_ = coefficient_factor_ = factor;
    }

    /// Largest friction force of soil at rest, N, for a normal force, N, a
    /// maximum shear stress, Pa, which may be infinite, and an area in contact,
    /// m^(dim-1).
    double
    largest_force(const double normal_force,
                  const double maximum_shear_stress,
                  const double area) const
    {
      return std::min(coefficient() * normal_force,
                      limit_of_stress(maximum_shear_stress, area));
    }

    /// Friction force of soil at rest whatever its normal force, N; infinite for
    /// an infinite maximum shear stress.
    double
    limit_of_stress(double maximum_shear_stress, double area) const;

    /// Force of the film, N, at a slip velocity, m/s.
    double
    film_force(double slip_velocity, double area) const;

    /// Length of the tangential impulse of a step of @p dt s, N s. @p trial is
    /// the impulse that would stop the soil, N s, @p mass the mass that the
    /// surface sees, kg, @p largest_force the friction of soil at rest, N. The
    /// film is taken implicitly: with the slip velocity u that is left,
    /// mass u + dt film_force(u) = trial - dt largest_force.
    double
    impulse(double trial,
            double mass,
            double largest_force,
            double area,
            double dt) const;

    /// Weight of the current normal force in the running mean, at a slip of
    /// @p slip m in the step, on cells of @p cell_size m. The mean forgets
    /// within 32 steps, and within 0.05 cells of slip.
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
