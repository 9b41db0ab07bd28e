// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/static_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Contact states are kept between load steps: if all nodes started by
  /// sticking, each step would have to find the slipping nodes again, with one
  /// Newton loop after another. States belong to the places of the nodes, as
  /// node numbers change.
  template <int dim>
  void
  StaticContact<dim>::begin(const StaticProblem<dim> &problem,
                            const Unknowns<dim>      &unknowns,
                            const double              modulus)
  {
    problem.contact.find_constraints(problem.state);
    facets_.begin(problem, unknowns, modulus);
    const auto           &nodes       = problem.contact.face_nodes();
    const auto           &constraints = problem.contact.constraints();
    const auto           &active      = unknowns.active_nodes();
    std::vector<PlaceKey> places;
    std::vector<Contact>  contacts;
    for (unsigned int k = 0; k < active.size(); ++k)
      nodes.for_each_at(active[k], [&](const unsigned int i) {
        Contact contact;
        contact.node  = active[k];
        contact.k     = k;
        contact.face  = nodes[i].face;
        contact.place = constraints.place_of_node(i);
        contact.walls = nodes[i].walls;
        // Same area as in the dynamics: both must find the same friction.
        contact.area  = constraints[contact.place].area;
        contact.limit = constraints.limit(contact.place);
        contacts.push_back(contact);
        places.push_back(nodes[i].key);
      });
    contacts_.update(std::move(places));
    for (unsigned int i = 0; i < contacts.size(); ++i)
      {
        contacts[i].values() = contacts_[i].values();
        contacts_[i]         = contacts[i];
        limit_friction(contacts_[i]);
      }
  }



  template <int dim>
  void
  StaticContact<dim>::list_state(StateList                   &list,
                                 const std::function<bool()> &is_needed)
  {
    contacts_.list_state("static contact with the seabed", list, is_needed);
    facets_.list_state(list, is_needed);
  }



  /// Bit d stands for component d. Slipping nodes are held along the normal
  /// only, open nodes only by walls.
  template <int dim>
  std::vector<unsigned char>
  StaticContact<dim>::constrained(const StaticProblem<dim> &problem,
                                  const Unknowns<dim>      &unknowns) const
  {
    std::vector<unsigned char> result;
    for (const unsigned int node : unknowns.active_nodes())
      result.push_back(problem.boundaries.components_constrained_by_walls(
        problem.state.grid.faces_of_node(node)));
    for (const Contact &contact : contacts_.all())
      if (contact.state == State::sticks)
        result[contact.k] = (1u << dim) - 1;
      else if (contact.state == State::slips)
        result[contact.k] |= 1u << (contact.face / 2);
    return result;
  }



  /// Friction on the soil after the slip in the step, N.
  template <int dim>
  Tensor<1, dim>
  StaticContact<dim>::Contact::friction_after_slip() const
  {
    const double before = limit.force(normal_force);
    return limit.softens() && slip > 0 && before > 0
             ? (limit.force(normal_force, slip) / before) * friction
             : friction;
  }



  /// Derivative of the length of friction_after_slip() by the slip, N/m.
  template <int dim>
  double
  StaticContact<dim>::Contact::softening() const
  {
    const double before = limit.force(normal_force);
    return limit.softens() && before > 0
             ? friction.norm() / before * limit.slope(normal_force, slip)
             : 0.;
  }



  template <int dim>
  void
  StaticContact<dim>::set_slip(const std::vector<double> &u)
  {
    for (Contact &contact : contacts_)
      {
        contact.slip = 0;
        if (contact.state != State::slips || !contact.limit.softens())
          continue;
        const double length = contact.friction.norm();
        // Soil slips against the friction.
        for (unsigned int d = 0; d < dim && length > 0; ++d)
          contact.slip -=
            contact.friction[d] / length * u[dim * contact.node + d];
        contact.slip = std::max(contact.slip, 0.);
      }
  }



  /// The friction of a slipping node does not depend on the normal force within
  /// a loop of Newton's method: the matrix stays symmetric, and
  /// update_active_set() corrects the force between the loops. What slip takes
  /// away depends on the displacement, so that a load step either ends on a
  /// balance or fails.
  template <int dim>
  void
  StaticContact<dim>::add_friction(std::vector<double> &forces) const
  {
    for (const Contact &contact : contacts_.all())
      if (contact.state == State::slips)
        {
          const Tensor<1, dim> friction = contact.friction_after_slip();
          for (unsigned int d = 0; d < dim; ++d)
            forces[dim * contact.node + d] += friction[d];
        }
  }



  template <int dim>
  void
  StaticContact<dim>::add_to_matrix(StiffnessMatrix<dim> &matrix) const
  {
    FullMatrix<double> block(dim, dim);
    for (const Contact &contact : contacts_.all())
      {
        const double softening =
          contact.state == State::slips ? contact.softening() : 0.;
        if (softening == 0)
          continue;
        const Tensor<1, dim> along = contact.friction / contact.friction.norm();
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            block(i, j) = softening * along[i] * along[j];
        matrix.add(ArrayView<const unsigned int>(&contact.node, 1), block);
      }
  }



  template <int dim>
  void
  StaticContact<dim>::commit(const StaticProblem<dim>  &problem,
                             const std::vector<double> &u,
                             const StrainMeasure        measure)
  {
    set_slip(u);
    for (Contact &contact : contacts_)
      if (contact.slip > 0)
        {
          problem.contact.slip().add(contact.place, contact.slip);
          contact.friction = contact.friction_after_slip();
          contact.slip     = 0;
        }
    facets_.commit(problem, u, measure);
  }



  /// Slipping nodes have friction in addition to the normal reaction. At
  /// sticking nodes the reaction contains all of the force, and open nodes have
  /// no force.
  template <int dim>
  void
  StaticContact<dim>::add_contact_force(const double         factor,
                                        std::vector<double> &forces) const
  {
    for (const Contact &contact : contacts_.all())
      for (unsigned int d = 0; d < dim; ++d)
        if (contact.state != State::open)
          forces[dim * contact.node + d] +=
            factor *
            (contact.reaction[d] +
             (contact.state == State::slips ? contact.friction[d] : 0.));
  }



  /// Cut the force along the seabed to mu N or tau_max A, with the normal force
  /// N of the last step. The limit may have fallen: strength reduction weakens
  /// the seabed, and the area in contact changes with the soil. Components held
  /// by walls are not friction and stay.
  template <int dim>
  void
  StaticContact<dim>::limit_friction(Contact &contact) const
  {
    // The seabed pushes against the outer normal; the force is positive on
    // pressed soil.
    const unsigned int axis     = contact.face / 2;
    const double       outwards = (contact.face % 2 == 0 ? -1. : 1.);
    contact.normal_force  = std::max(-outwards * contact.reaction[axis], 0.);
    const double    limit = contact.limit.force(contact.normal_force);
    Tensor<1, dim> &force =
      (contact.state == State::slips ? contact.friction : contact.reaction);
    Tensor<1, dim> tangential = force;
    tangential[axis]          = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      if (contact.walls & (1u << d))
        tangential[d] = 0.;
    if (tangential.norm() > limit)
      force -= (1. - limit / tangential.norm()) * tangential;
  }



  /// Update the state of one node after a solution, by the rules
  ///   open    -> sticks  if soil has moved into the seabed;
  ///   any     -> open    if the seabed would have to pull;
  ///   sticks  -> slips   if the force along the seabed exceeds the largest
  ///                      friction, which then acts in the same direction;
  ///   slips   -> sticks  if the node moved along the friction.
  /// The friction of a slipping node follows the normal force, and its change
  /// counts as a change of state. The direction of slip is kept from the start
  /// of slip; in 2-D there is only one. Forces are compared with a slack of
  /// 1e-6 times @p weight, N, so that round-off does not change states for
  /// ever.
  template <int dim>
  bool
  StaticContact<dim>::update_active_set(Contact              &contact,
                                        const Tensor<1, dim> &reaction,
                                        const Tensor<1, dim> &u,
                                        const double          weight) const
  {
    const unsigned int axis     = contact.face / 2;
    const double       outwards = (contact.face % 2 == 0 ? -1. : 1.);
    if (contact.state == State::open)
      {
        if (outwards * u[axis] <= 0.)
          return false;
        contact.state = State::sticks;
        return true;
      }
    const double normal_force = -outwards * reaction[axis];
    if (normal_force < -1e-6 * weight)
      {
        contact.state = State::open;
        return true;
      }
    const Tensor<1, dim> before = contact.friction_after_slip();
    contact.normal_force        = std::max(normal_force, 0.);
    const double   limit        = contact.limit.force(contact.normal_force);
    Tensor<1, dim> tangential;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis && !(contact.walls & (1u << d)))
        tangential[d] =
          (contact.state == State::sticks ? reaction : contact.friction)[d];
    if (contact.state == State::sticks)
      {
        if (tangential.norm() <= limit + 1e-6 * weight)
          return false;
        contact.state    = State::slips;
        contact.friction = limit / tangential.norm() * tangential;
        return true;
      }
    // A slipping node must move against the friction.
    if (u * tangential > 0.)
      {
        contact.state = State::sticks;
        return true;
      }
    if (tangential.norm() > 0.)
      contact.friction = limit / tangential.norm() * tangential;
    return (contact.friction_after_slip() - before).norm() > 1e-6 * weight;
  }



  /// @p reaction is the negative residual, so it is valid at held components
  /// only; free components hold the residual left by Newton's method.
  template <int dim>
  unsigned int
  StaticContact<dim>::update_active_set(const StaticProblem<dim>  &problem,
                                        const Unknowns<dim>       &unknowns,
                                        const std::vector<double> &reaction,
                                        std::vector<double>       &u,
                                        const double facet_tolerance)
  {
    unsigned int n_changes = 0;
    for (Contact &contact : contacts_)
      {
        Tensor<1, dim> force, displacement;
        for (unsigned int d = 0; d < dim; ++d)
          {
            force[d]        = reaction[dim * contact.node + d];
            displacement[d] = u[dim * contact.node + d];
          }
        contact.reaction = Tensor<1, dim>();
        for (unsigned int d = 0; d < dim; ++d)
          // At open nodes the normal component is free, and its force nearly
          // zero.
          if (contact.state == State::sticks || d == contact.face / 2)
            contact.reaction[d] = force[d];
        // Force at the node plus weight of its soil, as either may be zero.
        const double weight =
          force.norm() + unknowns.mass(contact.node) *
                           problem.loads.acceleration_of_body[0].norm();
        const bool was_open = (contact.state == State::open);
        if (!update_active_set(contact, force, displacement, weight))
          continue;
        ++n_changes;
        // The next loop holds the normal displacement at zero: on the seabed.
        if (was_open)
          u[dim * contact.node + contact.face / 2] = 0.;
      }
    const bool facets_rest =
      facets_.update(problem, unknowns, u, facet_tolerance);
    return (facets_rest ? 0 : 1) +
           Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  /// Only the sign of the direction counts: its size is the size of a
  /// correction from a nearly singular matrix.
  template <int dim>
  unsigned int
  StaticContact<dim>::stick_again(const Unknowns<dim>       &unknowns,
                                  const std::vector<double> &direction)
  {
    unsigned int n_changes = facets_.stick_again(direction);
    for (Contact &contact : contacts_)
      {
        double power = 0;
        for (unsigned int d = 0; d < dim; ++d)
          power += contact.friction[d] * direction[dim * contact.node + d];
        if (contact.state != State::slips || !(power > 0.))
          continue;
        contact.state = State::sticks;
        ++n_changes;
      }
    return Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  template class StaticContact<2>;
  template class StaticContact<3>;
} // namespace talus
