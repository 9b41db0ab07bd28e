// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/contact_area.h>
#include <talus/boundaries/seabed.h>
#include <talus/grid/node_places.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Seabed<dim>::Seabed()
    : ParameterAcceptor("/Boundaries/Seabed")
    , bed_("/Boundaries/Seabed",
           "1000",
           "Maximum shear stress tau_max that the seabed passes to the soil "
           "[Pa]: a number, or an expression in x, y (, z) and depth, the "
           "depth of the place below the mudline at the start [m], 0 without "
           "soil above.")
  {
    add_parameter("Gap",
                  has_gap_,
                  "Whether contact begins at the face: when the boxes of the "
                  "points come nearer than a twentieth of a cell, so that a "
                  "falling body stops at the face. Otherwise (as in the paper) "
                  "contact begins as soon as a node on the face carries soil, "
                  "up to a cell early.");
  }



  template <int dim>
  void
  Seabed<dim>::prepare(const Constants &constants)
  {
    bed_.prepare(constants);
    if (!bed_.depends_on_place())
      cap_ = bed_.maximum_shear_stress(Point<dim>());
  }



  template <int dim>
  void
  Seabed<dim>::prepare_nodes(const Grid<dim>               &grid,
                             const unsigned char            faces,
                             const std::vector<Point<dim>> &places)
  {
    if (faces == 0)
      return;
    if (bed_.depends_on_place())
      {
        cap_of_node_.assign(places.size(), 0.);
        for (unsigned int node = 0; node < places.size(); ++node)
          if (grid.faces_of_node(node) & faces)
            cap_of_node_[node] = bed_.maximum_shear_stress(places[node]);
      }
    const std::vector<unsigned long> keys_of_nodes = keys_of_owned_nodes(grid);
    std::vector<PlaceKey>            keys;
    std::vector<BedPlace<dim>>       on_bed;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        place_of_[face].clear();
        for (unsigned int node = 0; node < keys_of_nodes.size(); ++node)
          if (grid.faces_of_node(node) & faces & (1u << face))
            {
              place_of_[face][node] = keys.size();
              keys.push_back(place_key(keys_of_nodes[node], face));
              if (keeps_slip())
                on_bed.push_back({keys.back(),
                                  places[node],
                                  grid.face_share(face, node).area});
            }
      }
    forces_.move_to(std::move(keys), grid.communicator());
    if (keeps_slip())
      slip_.prepare(std::move(on_bed), grid.communicator());
  }



  template <int dim>
  void
  Seabed<dim>::begin_step(const MPI_Comm communicator)
  {
    slip_.begin_step(communicator);
    if (forces_.is_waiting())
      forces_.update(forces_.places());
    for (MeanNormalForce &force : forces_)
      force.begin_step();
    area_in_contact_ = 0;
  }



  template <int dim>
  CoulombLimit
  Seabed<dim>::limit(const unsigned int face,
                     const unsigned int node,
                     const double       area) const
  {
    const double share = share_left_ ? share_left_(face, node) : 1.;
    return bed_.limit(share * maximum_shear_stress(node),
                      area,
                      keeps_slip() ? slip_.state(place_of(face, node))
                                   : SurfaceState());
  }



  template <int dim>
  double
  Seabed<dim>::contact_area(const NodalFields<dim> &nodes,
                            const Grid<dim>        &grid,
                            const unsigned int      face,
                            const unsigned int      node) const
  {
    const double area = grid.face_share(face, node).area;
    const double f    = volume_fraction_at_face(nodes, grid, face, node);
    return area *
           share_in_contact(std::min(1., covered_area_(face, node) / area), f);
  }



  // The trial velocity is the velocity after the momentum update, without the
  // seabed. The impact along the normal is plastic: the impulse m v_n stops the
  // node, N = m v_n/dt is the force. Friction can at most stop the node, never
  // drive the node back; at rest friction bears the load, and no penalty
  // stiffness limits the step. Nothing pulls: a node moving away is free along
  // the normal, so soil can lift off.
  //
  // A shaking node would have no friction in every step in which the node moves
  // away, and a body at rest would creep: so friction follows the mean normal
  // force, also in these steps.
  template <int dim>
  std::pair<Tensor<1, dim>, Tensor<1, dim>>
  Seabed<dim>::apply(NodalFields<dim>  &nodes,
                     const Grid<dim>   &grid,
                     const unsigned int face,
                     const unsigned int node,
                     const double       dt,
                     const double       gap)
  {
    const unsigned int   axis     = face / 2;
    const double         outwards = (face % 2 == 0 ? -1. : 1.);
    const Tensor<1, dim> trial    = nodes.velocity(node);
    const double         mass     = nodes.mass(node);
    // Normal velocity beyond the velocity that closes the gap.
    const double v_n = outwards * trial[axis] - gap / dt;
    if (gap > 0 && v_n <= 0)
      return {};

    Tensor<1, dim> v_t                   = trial;
    v_t[axis]                            = 0;
    const double       speed             = v_t.norm();
    const auto        &share             = grid.face_share(face, node);
    const double       cell_size         = 2. * share.volume / share.area;
    const double       normal            = mass * std::max(0., v_n);
    const unsigned int place             = place_of(face, node);
    const double       mean_normal_force = forces_[place].update(
      normal / dt, InterfaceFriction::averaging_weight(speed * dt, cell_size));
    const double area = contact_area(nodes, grid, face, node);
    if (face == bottom_face && mean_normal_force > 0)
      area_in_contact_ += area;
    const double largest_friction =
      limit(face, node, area).force(mean_normal_force);
    const double friction = bed_.impulse(mass * speed,
                                         mass,
                                         largest_friction,
                                         mean_normal_force > 0 ? area : 0.,
                                         dt);
    // A sticking node does not slip, and soil without friction remoulds
    // nothing.
    if (bed_.softens() && largest_friction > 0 && friction < mass * speed)
      slip_.add(place, (speed - friction / mass) * dt);

    Tensor<1, dim> normal_impulse;
    normal_impulse[axis] = -outwards * normal;
    Tensor<1, dim> tangential_impulse;
    // Without motion along the face friction has no direction.
    if (speed > 0)
      tangential_impulse = (-friction / speed) * v_t;
    nodes.set_velocity(node,
                       trial + (normal_impulse + tangential_impulse) / mass);
    return {normal_impulse, tangential_impulse};
  }



  template class Seabed<2>;
  template class Seabed<3>;
} // namespace talus
