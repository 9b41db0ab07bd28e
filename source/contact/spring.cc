// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/spring.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  double
  Spring::force_at(const double elongation) const
  {
    return std::clamp(stiffness_ * (elongation - slip_),
                      -yield_force_,
                      yield_force_);
  }



  Spring::Resistance
  Spring::resistance(const double before,
                     const double after,
                     const double dt) const
  {
    const double force = force_at(elongation_after(before, after, dt));
    const double slope =
      0.5 * dt * damping_ +
      (std::abs(force) < yield_force_ ? 0.25 * dt * dt * stiffness_ : 0.);
    return {0.5 * dt *
              (force_at(elongation_) + force + damping_ * (before + after)),
            slope};
  }



  // The resistance is linear in the velocity up to the yield force and constant
  // beyond, apart from the dashpot: the solution of one of the two parts holds.
  double
  Spring::velocity_after(const double mass,
                         const double before,
                         const double impulse,
                         const double dt) const
  {
    const double k        = 0.25 * dt * dt * stiffness_;
    const double c        = 0.5 * dt * damping_;
    const double start    = force_at(elongation_);
    const double momentum = (mass - c) * before + impulse;
    const double elastic =
      (momentum - k * before - dt * start) / (mass + c + k);
    const double force =
      stiffness_ * (elongation_after(before, elastic, dt) - slip_);
    if (std::abs(force) <= yield_force_)
      return elastic;
    return (momentum -
            0.5 * dt * (start + std::copysign(yield_force_, force))) /
           (mass + c);
  }



  double
  Spring::advance(const double before, const double after, const double dt)
  {
    const double start      = force_at(elongation_);
    const double elongation = elongation_after(before, after, dt);
    const double end        = force_at(elongation);
    const double velocity   = 0.5 * (before + after);
    const double slip =
      stiffness_ > 0 ? elongation - end / stiffness_ - slip_ : 0.;
    force_      = -0.5 * (start + end) - damping_ * velocity;
    elongation_ = elongation;
    // Within the yield force the difference is round-off.
    const bool yields = std::abs(end) >= yield_force_;
    if (yields)
      slip_ += slip;
    return (yields ? 0.5 * (start + end) * slip : 0.) +
           damping_ * velocity * velocity * dt;
  }



  double
  Spring::stored_energy() const
  {
    const double force = force_at(elongation_);
    return stiffness_ > 0 ? 0.5 * force * force / stiffness_ : 0.;
  }



  void
  Spring::list_state(const std::string &name, StateList &list)
  {
    list.add("spring elongation of " + name, "", elongation_, Reduction::equal);
    list.add("spring slip of " + name, "", slip_, Reduction::equal);
    list.add("spring force of " + name, "", force_, Reduction::equal);
  }
} // namespace talus
