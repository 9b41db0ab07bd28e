#include <talus/boundaries/contact_area.h>
#include <talus/equilibrium/static_contact.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  StaticContact<dim>::begin(const StaticProblem<dim> &problem,
                            const Unknowns<dim>      &unknowns)
  {
    std::map<unsigned int, Contact> known;
    for (const Contact &contact : contacts_)
      known[contact.node] = contact;
    contacts_.clear();
    const auto &active = unknowns.active_nodes();
    for (unsigned int k = 0; k < active.size(); ++k)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (const unsigned char faces =
              problem.state.grid.faces_of_node(active[k]);
            (faces & (1u << face)) &&
            problem.boundaries.condition(face) == FaceCondition::seabed)
          {
            Contact contact;
            contact.node = active[k];
            contact.k    = k;
            contact.face = face;
            contact.walls =
              problem.boundaries.components_constrained_by_walls(faces);
            contact.area = contact_area(problem.state.nodes,
                                        problem.state.grid,
                                        face,
                                        contact.node);
            if (const auto before = known.find(contact.node);
                before != known.end() && before->second.face == face)
              {
                contact.state    = before->second.state;
                contact.friction = before->second.friction;
                contact.reaction = before->second.reaction;
                limit_friction(contact, problem.boundaries.seabed());
              }
            contacts_.push_back(contact);
          }
  }



  template <int dim>
  std::vector<unsigned char>
  StaticContact<dim>::constrained(const StaticProblem<dim> &problem,
                                  const Unknowns<dim>      &unknowns) const
  {
    std::vector<unsigned char> result;
    for (const unsigned int node : unknowns.active_nodes())
      result.push_back(problem.boundaries.components_constrained_by_walls(
        problem.state.grid.faces_of_node(node)));
    for (const Contact &contact : contacts_)
      if (contact.state == State::sticks)
        result[contact.k] = (1u << dim) - 1;
      else if (contact.state == State::slips)
        result[contact.k] |= 1u << (contact.face / 2);
    return result;
  }



  template <int dim>
  void
  StaticContact<dim>::add_friction(std::vector<double> &forces) const
  {
    for (const Contact &contact : contacts_)
      if (contact.state == State::slips)
        for (unsigned int d = 0; d < dim; ++d)
          forces[dim * contact.node + d] += contact.friction[d];
  }



  template <int dim>
  void
  StaticContact<dim>::add_contact_force(const double         factor,
                                        std::vector<double> &forces) const
  {
    for (const Contact &contact : contacts_)
      for (unsigned int d = 0; d < dim; ++d)
        if (contact.state != State::open)
          forces[dim * contact.node + d] +=
            factor *
            (contact.reaction[d] +
             (contact.state == State::slips ? contact.friction[d] : 0.));
  }



  /// What the node bore along the seabed may be more than it bears now.
  template <int dim>
  void
  StaticContact<dim>::limit_friction(Contact           &contact,
                                     const Seabed<dim> &seabed) const
  {
    const unsigned int axis         = contact.face / 2;
    const double       outwards     = (contact.face % 2 == 0 ? -1. : 1.);
    const double       normal_force = -outwards * contact.reaction[axis];
    const double       limit =
      seabed.largest_friction(std::max(normal_force, 0.), contact.area);
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



  /// @p weight, N, is what forces are small against.
  template <int dim>
  bool
  StaticContact<dim>::update_active_set(Contact              &contact,
                                        const Seabed<dim>    &seabed,
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
    const double limit =
      seabed.largest_friction(std::max(normal_force, 0.), contact.area);
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
    // It must slip against the friction.
    if (u * tangential > 0.)
      {
        contact.state = State::sticks;
        return true;
      }
    const Tensor<1, dim> before = contact.friction;
    if (tangential.norm() > 0.)
      contact.friction = limit / tangential.norm() * tangential;
    return (contact.friction - before).norm() > 1e-6 * weight;
  }



  template <int dim>
  unsigned int
  StaticContact<dim>::update_active_set(const StaticProblem<dim>  &problem,
                                        const Unknowns<dim>       &unknowns,
                                        const std::vector<double> &reaction,
                                        std::vector<double>       &u)
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
          if (contact.state == State::sticks || d == contact.face / 2)
            contact.reaction[d] = force[d];
        const double weight =
          force.norm() + unknowns.mass(contact.node) *
                           problem.loads.acceleration_of_body[0].norm();
        const bool was_open = (contact.state == State::open);
        if (!update_active_set(contact,
                               problem.boundaries.seabed(),
                               force,
                               displacement,
                               weight))
          continue;
        ++n_changes;
        if (was_open)
          u[dim * contact.node + contact.face / 2] = 0.;
      }
    return Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  template <int dim>
  unsigned int
  StaticContact<dim>::stick_again(const Unknowns<dim>       &unknowns,
                                  const std::vector<double> &direction)
  {
    unsigned int n_changes = 0;
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
