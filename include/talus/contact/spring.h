// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_spring_h
#define talus_contact_spring_h

#include <talus/base/state_list.h>

#include <limits>
#include <string>

namespace talus
{
  /// Spring along one axis of a rigid body: elastic up to a yield force,
  /// perfectly plastic beyond, with a linear dashpot beside it. For a rotation,
  /// forces are moments, N m, and lengths are angles, rad.
  ///
  /// A step takes the velocity from v- to v+, both at the middles of steps. The
  /// elongation at the middle of a step changes by dt (v- + v+)/2, and the
  /// force in the step is the mean of the forces at both elongations (average
  /// acceleration, @cite newmark1959): stable for any stiffness, and the works
  /// of a step balance to round-off.
  class Spring
  {
  public:
    Spring() = default;

    /// @p stiffness N/m, @p damping N s/m, @p yield_force N, may be infinite.
    Spring(const double stiffness,
           const double damping,
           const double yield_force)
      : stiffness_(stiffness)
      , damping_(damping)
      , yield_force_(yield_force)
    {}

    /// Impulse of a step against the motion, N s, and its derivative by the
    /// velocity after the step, kg.
    struct Resistance
    {
      double impulse, slope;
    };

    /// Return the resistance in a step of @p dt, s, in which the velocity
    /// changes from @p before to @p after, m/s.
    Resistance
    resistance(double before, double after, double dt) const;

    /// Return the velocity, m/s, of @p mass, kg, after a step of @p dt, s,
    /// which begins with the velocity @p before, m/s. @p impulse: of all other
    /// forces, N s.
    double
    velocity_after(double mass, double before, double impulse, double dt) const;

    /// Move by a step of @p dt, s, in which the velocity changes from @p before
    /// to @p after, m/s. Return the energy lost by yield and dashpot, J.
    double
    advance(double before, double after, double dt);

    /// Force on the body in the last step, N.
    double
    force() const
    {
      return force_;
    }

    /// Plastic part of the elongation, m.
    double
    slip() const
    {
      return slip_;
    }

    /// Elastic energy, J.
    double
    stored_energy() const;

    /// @p name of body and axis.
    void
    list_state(const std::string &name, StateList &list);

  private:
    /// Force of the spring at an elongation, N, within the yield force.
    double
    force_at(double elongation) const;
    double
    elongation_after(double before, double after, double dt) const
    {
      return elongation_ + 0.5 * dt * (before + after);
    }

    double stiffness_   = 0;
    double damping_     = 0;
    double yield_force_ = std::numeric_limits<double>::infinity();

    double elongation_ = 0; ///< at the middle of the last step, m
    double slip_       = 0; ///< m
    double force_      = 0; ///< N
  };
} // namespace talus

#endif
