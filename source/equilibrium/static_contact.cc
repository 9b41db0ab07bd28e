#include <talus/boundaries/contact_area.h>
#include <talus/equilibrium/static_contact.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  StaticContact<dim>::begin(const Soil<dim>     &soil,
                            const Unknowns<dim> &unknowns)
  {
    std::map<unsigned int, Contact> known;
    for (const Contact &contact : contacts_)
      known[contact.node] = contact;
    contacts_.clear();
    const auto &active = unknowns.active_nodes();
    for (unsigned int k = 0; k < active.size(); ++k)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (const unsigned char faces = soil.grid.faces_of_node(active[k]);
            (faces & (1u << face)) &&
            soil.boundaries.condition(face) == FaceCondition::seabed)
          {
            Contact contact;
            contact.node  = active[k];
            contact.k     = k;
            contact.face  = face;
            contact.walls = soil.boundaries.components_held_by_walls(faces);
            contact.area =
              contact_area(soil.nodes, soil.grid, face, contact.node);
            if (const auto before = known.find(contact.node);
                before != known.end() && before->second.face == face)
              {
                contact.state    = before->second.state;
                contact.friction = before->second.friction;
              }
            contacts_.push_back(contact);
          }
  }



  template <int dim>
  std::vector<unsigned char>
  StaticContact<dim>::held(const Soil<dim>     &soil,
                           const Unknowns<dim> &unknowns) const
  {
    std::vector<unsigned char> result;
    for (const unsigned int node : unknowns.active_nodes())
      result.push_back(soil.boundaries.components_held_by_walls(
        soil.grid.faces_of_node(node)));
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



  /// @p weight, N, is what forces are small against.
  template <int dim>
  bool
  StaticContact<dim>::revise(Contact              &contact,
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
  StaticContact<dim>::revise(const Soil<dim>           &soil,
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
        const double weight =
          force.norm() + unknowns.mass(contact.node) *
                           soil.loads.acceleration_of_body[0].norm();
        const bool was_open = (contact.state == State::open);
        if (!revise(
              contact, soil.boundaries.seabed(), force, displacement, weight))
          continue;
        ++n_changes;
        if (was_open)
          u[dim * contact.node + contact.face / 2] = 0.;
      }
    return Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  template <int dim>
  unsigned int
  StaticContact<dim>::hold_back(const Unknowns<dim>       &unknowns,
                                const std::vector<double> &residual)
  {
    Tensor<1, dim> own;
    unknowns.for_free([&](const unsigned int node, const unsigned int d) {
      own[d] += residual[dim * node + d];
    });
    const Tensor<1, dim> all =
      Utilities::MPI::sum(own, unknowns.communicator());
    unsigned int n_changes = 0;
    for (Contact &contact : contacts_)
      if (contact.state == State::slips && contact.friction * all > 0.)
        {
          contact.state = State::sticks;
          ++n_changes;
        }
    return Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  template class StaticContact<2>;
  template class StaticContact<3>;
} // namespace talus
