// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/interface_friction.h>

#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // A ringing block (2600 steps a second, h/c 2.5 steps) needs more than 8
    // steps of memory; 16 to 64 steps give the same result. Without the memory
    // by slip, soil that slides at a quarter of its wave speed leaves a place
    // before friction responds to the normal force.
    constexpr double n_steps_of_memory = 32, slip_of_memory = 0.05;
  } // namespace



  InterfaceFriction::InterfaceFriction(const std::string &section)
    : ParameterAcceptor(section)
  {
    add_parameter("Friction coefficient",
                  coefficient_,
                  "Coulomb friction coefficient mu of soil on the surface [-].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter(
      "Film consistency",
      film_consistency_,
      "Consistency K of a film of mud between surface and soil "
      "[Pa s^n]: the film adds K (u/b)^n to the shear stress at the "
      "sliding velocity u, with the exponent n and the thickness b "
      "of the film. Models the sheared layer of mud that sticks to "
      "the base, where the cells are too coarse to resolve the "
      "layer. 0: no film.",
      this->prm,
      Patterns::Double(0.));
    add_parameter("Film exponent",
                  film_exponent_,
                  "Exponent n of the film, 1 for Bingham mud [-].",
                  this->prm,
                  Patterns::Double(0.1, 2.));
    add_parameter(
      "Film thickness",
      film_thickness_,
      "Thickness b of the film [m]; needed with 'Film consistency'.",
      this->prm,
      Patterns::Double(0.));
    add_parameter(
      "Slip to remould",
      slip_to_remould_,
      "Slip s_95 of the soil over a place of the surface after which 95 % of "
      "the loss of maximum shear stress has happened [m]: the maximum shear "
      "stress is multiplied by r + (1 - r) exp(-3 s/s_95) after the slip s, "
      "with the ratio r of 'Remoulded shear stress ratio'. The slip belongs to "
      "the place of the surface, not to the soil. 0: slip takes nothing away.",
      this->prm,
      Patterns::Double(0.));
    add_parameter("Remoulded shear stress ratio",
                  remoulded_ratio_,
                  "Share r of the maximum shear stress left after a long slip "
                  "[-], one over the sensitivity of clay; needed with 'Slip to "
                  "remould'.",
                  this->prm,
                  Patterns::Double(0., 1.));
  }



  void
  InterfaceFriction::check() const
  {
    const std::string section = get_section_name().substr(1);
    AssertThrow(film_consistency_ == 0 || film_thickness_ > 0,
                ExcUser(text("'",
                             section,
                             "/Film consistency = ",
                             film_consistency_,
                             "' asks for a film, but '",
                             section,
                             "/Film thickness' is 0. Give the thickness of the "
                             "sheared layer at the base in m.")));
    AssertThrow(film_consistency_ > 0 || film_thickness_ == 0,
                ExcUser(text("'",
                             section,
                             "/Film thickness = ",
                             film_thickness_,
                             "' is given, but '",
                             section,
                             "/Film consistency' is 0, so that the film passes "
                             "no stress. Give the consistency in Pa s^n, or "
                             "remove the thickness.")));
    AssertThrow(softens() == (remoulded_ratio_ < 1),
                ExcUser(text("'",
                             section,
                             "/Slip to remould' is ",
                             slip_to_remould_,
                             " m and '",
                             section,
                             "/Remoulded shear stress ratio' is ",
                             remoulded_ratio_,
                             "; a surface that softens by slip needs a slip of "
                             "more than 0 and a ratio of less than 1. Give "
                             "both or neither.")));
  }



  double
  InterfaceFriction::share_after_slip(const double slip) const
  {
    return softens()
             ? remoulded_ratio_ + (1. - remoulded_ratio_) *
                                    std::exp(-3. * slip / slip_to_remould_)
             : 1.;
  }



  // Not the product: a triggered place is brought to a share of its strength,
  // and remoulded soil cannot be remoulded again.
  double
  InterfaceFriction::share_left(const SurfaceState &state) const
  {
    const double share = share_after_slip(state.slip);
    return state.is_triggered ? std::min(region_factor_, share) : share;
  }



  CoulombLimit
  InterfaceFriction::limit(const double        maximum_shear_stress,
                           const double        area,
                           const SurfaceState &state) const
  {
    CoulombLimit result;
    result.coefficient = coefficient();
    result.cap         = std::numeric_limits<double>::infinity();
    if (film_consistency_ > 0)
      {
        result.film =
          area * film_consistency_ / std::pow(film_thickness_, film_exponent_);
        result.film_exponent = film_exponent_;
      }
    if (std::isinf(maximum_shear_stress))
      return result;
    const double intact = shear_stress_factor_ * maximum_shear_stress * area;
    result.cap          = intact * share_left(state);
    if (!softens())
      return result;
    result.residual = remoulded_ratio_ * intact;
    result.excess   = intact * share_after_slip(state.slip) - result.residual;
    result.rate     = 3. / slip_to_remould_;
    if (state.is_triggered)
      result.ceiling = region_factor_ * intact;
    return result;
  }



  // An explicit stiff film would reverse the motion. The residual increases
  // with the slip velocity, so Newton's method between bounds finds the root;
  // for exponents below 1 the slope is infinite at 0.
  double
  CoulombLimit::impulse(const double trial,
                        const double mass,
                        const double normal_force,
                        const double dt) const
  {
    const double rest = dt * force(normal_force);
    if (trial <= rest)
      return trial;
    if (film == 0 || normal_force <= 0)
      return rest;
    const double excess = trial - rest;
    if (film_exponent == 1.)
      return rest + excess * dt * film / (mass + dt * film);
    double lower = 0, upper = excess / mass, u = upper;
    for (unsigned int i = 0; i < 60; ++i)
      {
        const double braking        = dt * film * std::pow(u, film_exponent);
        const double error          = mass * u + braking - excess;
        (error > 0 ? upper : lower) = u;
        const double before         = u;
        u -= error / (mass + film_exponent * braking / u);
        if (!(u > lower && u < upper))
          u = 0.5 * (lower + upper);
        if (std::abs(u - before) <= 1e-14 * before)
          break;
      }
    // Lies between rest and trial, whatever the error of the root.
    return trial - mass * u;
  }



  double
  InterfaceFriction::averaging_weight(const double slip, const double cell_size)
  {
    return std::min(1.,
                    1. / n_steps_of_memory +
                      slip / (slip_of_memory * cell_size));
  }
} // namespace talus
