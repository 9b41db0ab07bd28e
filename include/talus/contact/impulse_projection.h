// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_impulse_projection_h
#define talus_contact_impulse_projection_h

#include <talus/contact/contact_constraints.h>
#include <talus/contact/contact_impulses.h>

namespace talus
{
  /// Return the running mean of the normal impulse including @p newest, the
  /// normal impulse of the current step, N s.
  template <int dim>
  double
  mean_normal(const ContactImpulse<dim>    &impulse,
              const ContactConstraint<dim> &constraint,
              const double                  newest)
  {
    return impulse.mean_normal +
           constraint.averaging_weight * (newest - impulse.mean_normal);
  }



  /// Return @p v, shortened to the length @p limit if longer.
  template <int dim>
  dealii::Tensor<1, dim>
  cut_to_length(const dealii::Tensor<1, dim> &v, const double limit)
  {
    const double length = v.norm();
    return length > limit ? v * (limit / length) : v;
  }



  /// Impulse of a place after a sweep, on the soil.
  template <int dim>
  struct ProjectedImpulse
  {
    double                 normal = 0;   ///< N s, >= 0
    dealii::Tensor<1, dim> tangential;   ///< N s
    double                 sticking = 1; ///< tangential over trial length [-];
                                         ///< 1: the soil sticks
  };



  /// Project the impulse of place @p c, so that the soil at the place does not
  /// move into the surface: a normal impulse only pushes, and friction is at
  /// most the limit of the surface. A place with a gap lets the soil approach
  /// by the gap in this step.
  /// @param constraints of all places
  /// @param c number of the place
  /// @param normal unit vector out of the surface
  /// @param impulse of the place so far
  /// @param u velocity of the soil relative to the surface, m/s
  /// @param dt time step, s
  template <int dim>
  ProjectedImpulse<dim>
  projected_impulse(const ContactConstraints<dim> &constraints,
                    const unsigned int             c,
                    const dealii::Tensor<1, dim>  &normal,
                    const ContactImpulse<dim>     &impulse,
                    const dealii::Tensor<1, dim>  &u,
                    const double                   dt)
  {
    const ContactConstraint<dim> &constraint = constraints[c];
    const double                  u_n        = u * normal;
    const dealii::Tensor<1, dim>  u_t        = u - u_n * normal;
    ProjectedImpulse<dim>         result;
    result.normal = std::max(0.,
                             impulse.normal - constraint.normal_mass *
                                                (constraint.gap / dt + u_n));
    const dealii::Tensor<1, dim> trial =
      impulse.tangential - constraint.mass * u_t;
    const double length = trial.norm();
    result.tangential   = cut_to_length(
      trial,
      constraints.friction_impulse(
        c, length, mean_normal(impulse, constraint, result.normal), dt));
    if (length > 0)
      result.sticking = result.tangential.norm() / length;
    return result;
  }
} // namespace talus

#endif
