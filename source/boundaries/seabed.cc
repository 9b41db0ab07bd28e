// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/contact_area.h>
#include <talus/boundaries/seabed.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Seabed<dim>::Seabed()
    : ParameterAcceptor("/Boundaries/Seabed")
  {
    add_parameter("Friction coefficient",
                  friction_coefficient_,
                  "Coulomb friction coefficient mu of soil on the seabed [-].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter(
      "Maximum shear stress",
      maximum_shear_stress_text_,
      "Largest shear stress tau_max that the seabed passes to the "
      "soil [Pa]: a number, or an expression in x, y (, z) and "
      "depth, how far the place lies below the mudline of the start "
      "[m]; 0 where there was no soil above it.");
    add_parameter("Gap",
                  has_gap_,
                  "Let soil come to the seabed before it feels it: contact "
                  "begins where the boxes of the points come nearer than a "
                  "twentieth of a cell, and a falling body is caught at the "
                  "face. Else (as in the paper) a node on the face feels it as "
                  "soon as it carries soil, up to a cell early.");
  }



  template <int dim>
  void
  Seabed<dim>::prepare(const Constants &constants)
  {
    cap_ = std::make_unique<ShearStressCap<dim>>(
      "'Boundaries/Seabed/Maximum shear stress'",
      maximum_shear_stress_text_,
      constants);
  }



  template <int dim>
  void
  Seabed<dim>::locate(
    const std::vector<Point<dim>>                &places,
    const std::function<bool(unsigned int node)> &is_on_seabed)
  {
    cap_of_node_.assign(places.size(), 0.);
    for (unsigned int node = 0; node < places.size(); ++node)
      if (is_on_seabed(node))
        cap_of_node_[node] = cap_->at(places[node]);
  }



  // The trial velocity is that of the momentum update, without the seabed. A
  // plastic impact along the normal: the impulse m v_n stops the node, N = m
  // v_n/dt is the force that takes. Friction follows from this N and is at most
  // what stops the node, so it never drives it back, at rest it bears the load,
  // and no stiffness of a penalty limits the step. Nothing pulls: a node that
  // moves away is free, and so soil can lift off.
  //
  // The shear stress is capped per area in contact, and this area follows how
  // far soil fills the cells at the node (contact_area()): with the whole share
  // of the face a few points at the front would be held as firmly as a full
  // layer.
  template <int dim>
  std::pair<Tensor<1, dim>, Tensor<1, dim>>
  Seabed<dim>::apply(NodalFields<dim>  &nodes,
                     const Grid<dim>   &grid,
                     const unsigned int face,
                     const unsigned int node,
                     const double       dt,
                     const double       gap) const
  {
    const unsigned int   axis     = face / 2;
    const double         outwards = (face % 2 == 0 ? -1. : 1.);
    const Tensor<1, dim> trial    = nodes.velocity(node);
    const double         v_n      = outwards * trial[axis] - gap / dt;
    if (v_n <= 0)
      return {};

    const double mass         = nodes.mass(node);
    const double normal_force = mass * v_n / dt;

    // In 3-D the friction acts against the direction of sliding, whatever it
    // is.
    Tensor<1, dim> v_t = trial;
    v_t[axis]          = 0;
    const double speed = v_t.norm();
    const double friction =
      std::min(mass * speed / dt,
               largest_friction(node,
                                normal_force,
                                contact_area(nodes, grid, face, node)));

    Tensor<1, dim> normal_impulse;
    normal_impulse[axis] = -outwards * mass * v_n;
    Tensor<1, dim> tangential_impulse;
    // Without motion along the face there is no direction to act against.
    if (speed > 0)
      tangential_impulse = (-friction * dt / speed) * v_t;
    nodes.set_velocity(node,
                       trial + (normal_impulse + tangential_impulse) / mass);
    return {normal_impulse, tangential_impulse};
  }



  template class Seabed<2>;
  template class Seabed<3>;
} // namespace talus
