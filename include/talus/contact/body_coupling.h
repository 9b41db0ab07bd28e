// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_body_coupling_h
#define talus_contact_body_coupling_h

#include <talus/boundaries/reaction.h>
#include <talus/contact/contact_constraints.h>
#include <talus/contact/contact_impulses.h>
#include <talus/contact/facets.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace talus
{
  /// Velocities of obstacles with a mass in the contact iteration.
  ///
  /// A facet pushes soil and body apart by the same impulse. A body that moved
  /// by the impulses of the previous step would be unstable if lighter than the
  /// soil at its facets (added mass). So each sweep computes the velocity of
  /// the body with which its momentum balances exactly the impulses that the
  /// sweep will give to the facets. The impulses are piecewise linear in the
  /// velocity and never help the motion, so Newton's method finds the velocity
  /// in a few iterations, with one sum over the ranks in each.
  template <int dim>
  class BodyCoupling
  {
  public:
    BodyCoupling(Obstacles<dim>                &obstacles,
                 const Facets<dim>             &facets,
                 const ContactConstraints<dim> &constraints,
                 const ContactImpulses<dim>    &impulses)
      : obstacles_(obstacles)
      , facets_(facets)
      , constraints_(constraints)
      , impulses_(impulses)
    {}

    /// Begin a step: evaluate the forces on the bodies and list the loaded
    /// facets of each body. Call after ContactConstraints::find().
    void
    begin_step(const State<dim> &state);

    /// Compute the velocities of the bodies for the next sweep. Collective; no
    /// messages without bodies.
    void
    update_velocities(const State<dim> &state);

    /// Move the bodies with the impulses of @p reactions, one per obstacle, and
    /// record the energies of the step.
    void
    end_step(const std::vector<Reaction<dim>> &reactions, State<dim> &state);

    /// Open the accounts of end_step(), if there are bodies.
    void
    open_accounts(Accounts<dim> &accounts) const;

  private:
    static constexpr unsigned int n_axes = RigidBody<dim>::n_axes;
    using Vector                         = typename RigidBody<dim>::Vector;

    /// Response of the facets of a body to its velocity, by axis.
    struct Response
    {
      Vector impulse; ///< impulse of the soil on the body, N s
      Vector scale;   ///< sum of the absolute impulses, N s
      /// Decrease of the impulse by the velocity, kg.
      dealii::SymmetricTensor<2, n_axes> stiffness;

      /// Number of values in a message.
      static constexpr unsigned int n_values =
        2 * n_axes +
        dealii::SymmetricTensor<2, n_axes>::n_independent_components;

      void
      append_to(std::vector<double> &values) const;
      void
      read(const double *values);
    };

    /// State of Newton's method for one body.
    struct Iterate
    {
      Vector step;               ///< to the velocity that is tried, m/s
      double smallest_error = 0; ///< smallest imbalance so far, sqrt(J)
      bool   has_begun      = false;
      bool   is_final       = false;
    };

    std::vector<Response>
    find_responses(const State<dim> &state) const;
    void
    add_facet(unsigned int         c,
              const Obstacle<dim> &obstacle,
              const State<dim>    &state,
              Response            &response) const;
    static void
    improve(const Response &response, RigidBody<dim> &body, Iterate &iterate);

    Obstacles<dim>                &obstacles_;
    const Facets<dim>             &facets_;
    const ContactConstraints<dim> &constraints_;
    const ContactImpulses<dim>    &impulses_;

    // Data of one step, by entry of Obstacles::bodies()
    std::vector<std::vector<unsigned int>> facets_of_body_; ///< loaded facets
    std::vector<Iterate>                   iterates_;
  };
} // namespace talus

#endif
