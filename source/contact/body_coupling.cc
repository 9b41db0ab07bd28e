// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/contact/body_coupling.h>
#include <talus/contact/impulse_projection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // The impulses are piecewise linear in the velocity, and few facets change
    // sides in a step: the limit is not meant to be reached.
    constexpr unsigned int max_iterations = 40;

    // Imbalance of momentum, relative to the absolute terms.
    constexpr double tolerance_of_momentum = 1e-12;
  } // namespace



  template <int dim>
  void
  BodyCoupling<dim>::Response::append_to(std::vector<double> &values) const
  {
    for (unsigned int i = 0; i < n_axes; ++i)
      values.insert(values.end(), {impulse[i], scale[i]});
    for (unsigned int i = 0; i < stiffness.n_independent_components; ++i)
      values.push_back(stiffness.access_raw_entry(i));
  }



  template <int dim>
  void
  BodyCoupling<dim>::Response::read(const double *values)
  {
    for (unsigned int i = 0; i < n_axes; ++i)
      {
        impulse[i] = *values++;
        scale[i]   = *values++;
      }
    for (unsigned int i = 0; i < stiffness.n_independent_components; ++i)
      stiffness.access_raw_entry(i) = *values++;
  }



  template <int dim>
  void
  BodyCoupling<dim>::begin_step(const State<dim> &state)
  {
    const auto &bodies = obstacles_.bodies();
    facets_of_body_.resize(bodies.size());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        obstacles_[bodies[b]].body().begin_step(state.time, state.time_step);
        facets_of_body_[b].clear();
      }
    if (!bodies.empty())
      for (const unsigned int c : constraints_.loaded())
        if (const auto at = std::lower_bound(bodies.begin(),
                                             bodies.end(),
                                             facets_.owned()[c].obstacle);
            constraints_[c].normal_mass > 0 && at != bodies.end() &&
            *at == facets_.owned()[c].obstacle)
          facets_of_body_[at - bodies.begin()].push_back(c);
  }



  /// Add the projected impulse of facet @p c and its derivative. A facet with a
  /// normal impulse acts along the normal; friction acts along all tangents if
  /// the soil sticks, and across the slip if the soil slips.
  template <int dim>
  void
  BodyCoupling<dim>::add_facet(const unsigned int   c,
                               const Obstacle<dim> &obstacle,
                               const State<dim>    &state,
                               Response            &response) const
  {
    const double                  dt    = state.time_step;
    const ContactFacet<dim>      &facet = facets_.owned()[c];
    const ContactConstraint<dim> &at    = constraints_[c];
    const Tensor<1, dim> arm = facet.centroid - obstacle.reference_point();
    const auto           impulse =
      projected_impulse(constraints_,
                        c,
                        facet.normal,
                        impulses_[c],
                        constraints_.velocity(c) -
                          obstacle.velocity_at(facet.centroid,
                                               state.time + 0.5 * dt),
                        dt);
    const Vector on_body = RigidBody<dim>::by_axis(
      arm, -impulse.normal * facet.normal - impulse.tangential);
    response.impulse += on_body;
    for (unsigned int i = 0; i < n_axes; ++i)
      response.scale[i] += std::abs(on_body[i]);
    const auto add_direction = [&](const Tensor<1, dim> &direction,
                                   const double          mass) {
      const Vector v = RigidBody<dim>::by_axis(arm, direction);
      response.stiffness += mass * symmetrize(outer_product(v, v));
    };
    if (impulse.normal > 0)
      add_direction(facet.normal, at.normal_mass);
    Tensor<1, dim> slip;
    if (const double length = impulse.tangential.norm();
        impulse.sticking < 1 && length > 0)
      slip = impulse.tangential / length;
    for (unsigned int d = 0; d < dim; ++d)
      {
        Tensor<1, dim> tangent =
          -facet.normal[d] * facet.normal - slip[d] * slip;
        tangent[d] += 1.;
        add_direction(tangent, impulse.sticking * at.mass);
      }
  }



  /// Return the responses of all bodies to their present velocities, summed
  /// over the ranks. Collective.
  template <int dim>
  std::vector<typename BodyCoupling<dim>::Response>
  BodyCoupling<dim>::find_responses(const State<dim> &state) const
  {
    const auto           &bodies = obstacles_.bodies();
    std::vector<Response> result(bodies.size());
    std::vector<double>   values;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        if (!iterates_[b].is_final)
          for (const unsigned int c : facets_of_body_[b])
            add_facet(c, obstacles_[bodies[b]], state, result[b]);
        result[b].append_to(values);
      }
    Utilities::MPI::sum(values, state.communicator(), values);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      result[b].read(values.data() + b * Response::n_values);
    return result;
  }



  /// Improve the velocity of @p body by a step of Newton's method, so that the
  /// momentum balances the impulses of the facets. A step that does not reduce
  /// the imbalance is halved: facets may have begun or ceased to act.
  template <int dim>
  void
  BodyCoupling<dim>::improve(const Response &response,
                             RigidBody<dim> &body,
                             Iterate        &iterate)
  {
    const auto                 demand = body.demand();
    Vector                     imbalance;
    SymmetricTensor<2, n_axes> matrix = response.stiffness;
    double                     square = 0;
    iterate.is_final                  = true;
    for (unsigned int i = 0; i < n_axes; ++i)
      if (body.is_free(i))
        {
          imbalance[i] = response.impulse[i] - demand.impulse[i];
          square += imbalance[i] * imbalance[i] / body.inertia(i);
          matrix[i][i] += demand.slope[i];
          iterate.is_final =
            iterate.is_final &&
            std::abs(imbalance[i]) <=
              tolerance_of_momentum * (response.scale[i] + demand.scale[i]);
        }
      else
        for (unsigned int j = 0; j < n_axes; ++j)
          matrix[i][j] = (i == j ? 1. : 0.);
    if (iterate.is_final)
      return;
    const double error = std::sqrt(square);
    if (!iterate.has_begun || error < iterate.smallest_error)
      {
        iterate.has_begun      = true;
        iterate.smallest_error = error;
        iterate.step           = invert(matrix) * imbalance;
        body.set_velocity(body.velocity() + iterate.step);
      }
    else
      {
        iterate.step *= 0.5;
        body.set_velocity(body.velocity() - iterate.step);
      }
  }



  template <int dim>
  void
  BodyCoupling<dim>::update_velocities(const State<dim> &state)
  {
    const auto &bodies = obstacles_.bodies();
    if (bodies.empty())
      return;
    iterates_.assign(bodies.size(), {});
    for (unsigned int i = 0; i < max_iterations; ++i)
      {
        const std::vector<Response> responses = find_responses(state);
        bool                        is_final  = true;
        for (unsigned int b = 0; b < bodies.size(); ++b)
          if (!iterates_[b].is_final)
            {
              improve(responses[b], obstacles_[bodies[b]].body(), iterates_[b]);
              is_final = is_final && iterates_[b].is_final;
            }
        if (is_final)
          break;
      }
  }



  template <int dim>
  void
  BodyCoupling<dim>::open_accounts(Accounts<dim> &accounts) const
  {
    using Kind = typename Accounts<dim>::EnergyKind;
    if (obstacles_.bodies().empty())
      return;
    for (const char *name :
         {"obstacle kinetic energy", "spring energy", "spring work"})
      accounts.open_energy(name);
    for (const char *name : {"obstacle force work", "work on obstacles"})
      accounts.open_energy(name, Kind::supplied);
  }



  // All ranks compute the same motion; the first rank records the energies.
  template <int dim>
  void
  BodyCoupling<dim>::end_step(const std::vector<Reaction<dim>> &reactions,
                              State<dim>                       &state)
  {
    if (obstacles_.bodies().empty())
      return;
    typename RigidBody<dim>::Works works;
    for (const unsigned int k : obstacles_.bodies())
      {
        const StepReaction<dim> &of_soil = reactions[k].last;
        Vector                   impulse;
        for (unsigned int d = 0; d < dim; ++d)
          impulse[d] = of_soil.impulse[d];
        if (dim == 2)
          impulse[2] = of_soil.angular_impulse[0];
        works += obstacles_[k].body().end_step(impulse);
      }
    obstacles_.advance_bodies(state.time_step);
    if (!is_first_rank(state.communicator()))
      return;
    Accounts<dim> &accounts                    = state.accounts;
    accounts.energy("obstacle kinetic energy") = works.kinetic;
    accounts.energy("spring energy")           = works.stored;
    accounts.energy("spring work") += works.dissipated;
    accounts.energy("obstacle force work") += works.of_force;
    accounts.energy("work on obstacles") += works.of_soil;
  }



  template class BodyCoupling<2>;
  template class BodyCoupling<3>;
} // namespace talus
