// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/water/water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Water<dim>::Water(const Materials<dim> &materials,
                    const Contact<dim>   &contact)
    : ParameterAcceptor("/Water")
    , materials_(materials)
    , contact_(contact)
  {
    const auto add = [this](const std::string &name,
                            double            &value,
                            const std::string &sentence,
                            const double       least,
                            const double       most) {
      add_parameter(
        name, value, sentence, this->prm, Patterns::Double(least, most));
    };
    add("Density",
        density_,
        "Density of the water around the soil [kg/m^3].",
        1e-3,
        1e5);
    add("Added mass coefficient",
        added_mass_,
        "Mass of water accelerated with the soil, divided by the mass of the "
        "water displaced by the soil [-]; 0: none.",
        0.,
        1e3);
    add("Skin friction coefficient",
        skin_friction_,
        "Shear stress of the water on the free surface of the soil, divided by "
        "half the density of the water and the square of the velocity along "
        "the surface [-]; 0: none.",
        0.,
        1e3);
    add("Pressure drag coefficient",
        pressure_drag_,
        "Pressure of the water where the free surface moves outwards, divided "
        "by half the density of the water and the square of the velocity "
        "normal to the surface [-]; 0: none.",
        0.,
        1e3);
  }



  template <int dim>
  std::vector<double>
  Water<dim>::added_mass_of_bodies() const
  {
    std::vector<double> result;
    for (unsigned int b = 0; acts() && b < materials_.n_bodies(); ++b)
      result.push_back(added_mass_ * density_ /
                       materials_.of_body(b).density());
    return result;
  }



  template <int dim>
  std::vector<std::string>
  Water<dim>::notes() const
  {
    for (unsigned int b = 0; acts() && b < materials_.n_bodies(); ++b)
      {
        const double whole     = materials_.of_body(b).density();
        const double submerged = materials_.of_body(b).submerged_density();
        if (std::abs(whole - submerged - density_) > 0.01 * density_)
          return {text("Water of ",
                       density_,
                       " kg/m^3 acts on soil whose density and submerged "
                       "density, ",
                       whole,
                       " and ",
                       submerged,
                       " kg/m^3, differ by ",
                       whole - submerged,
                       " kg/m^3: saturated soil loses the weight of the "
                       "displaced water.")};
      }
    return {};
  }



  template <int dim>
  void
  Water<dim>::open_accounts(Accounts<dim> &accounts)
  {
    if (!acts())
      return;
    accounts.open_energy("drag work");
    accounts.open_impulse("drag impulse");
    accounts.open_stored_energy(
      "added mass kinetic energy",
      [added_mass = added_mass_of_bodies()](const Points<dim> &points) {
        double energy = 0;
        for (unsigned int p = 0; p < points.size(); ++p)
          energy += 0.5 * points.data(points.mass)[p] *
                    added_mass[points.data(points.body)[p]] *
                    load_place(points, points.velocity, p).norm_square();
        return energy;
      });
  }



  template <int dim>
  void
  Water<dim>::prepare(const Grid<dim> &grid)
  {
    if (!acts())
      return;
    surface_.prepare(grid);
    exchange_of_impulses_.prepare(grid, dim);
    impulses_.assign(std::size_t(dim) * grid.n_nodes(), 0.);
  }



  /// The facets stay where they are until soil may have moved by a tenth of a
  /// cell: the search for the free surface takes as long as the transfer of all
  /// points, and the drag is hardly affected.
  /// Velocities and shares of the facets are those of the step.
  template <int dim>
  void
  Water<dim>::begin_step(State<dim> &state)
  {
    constexpr double max_motion = 0.1; // cells
    if (!acts())
      return;
    if (state.max_path - path_at_surface_ >
        max_motion * state.grid.finest_size())
      {
        surface_.find(state, contact_);
        path_at_surface_ = state.max_path;
      }
    add_inertia(state.nodes);
  }



  template <int dim>
  void
  Water<dim>::list_state(StateList &list)
  {
    if (!acts())
      return;
    list.add("maximum path at the free surface",
             "m",
             path_at_surface_,
             Reduction::equal);
    surface_.list_state(list);
  }



  /// Add the inertia at the nodes only, since points carry the momentum of the
  /// soil. The added mass follows from the volume of soil at a node: an impulse
  /// then changes the momentum of soil and water together by exactly the
  /// impulse, whatever the densities of the bodies.
  template <int dim>
  void
  Water<dim>::add_inertia(NodalFields<dim> &nodes) const
  {
    if (added_mass_ > 0)
      for (const unsigned int node : nodes.active_nodes())
        if (nodes.mass(node) > 0)
          nodes.scale_inertia(node,
                              1. + added_mass_ * density_ * nodes.volume(node) /
                                     nodes.mass(node));
  }



  namespace
  {
    /// Impulse, N s, of a force that brakes a motion, and that falls with the
    /// motion during the step: the motion slows down and never reverses.
    /// @param impulse explicit value: force times time step, N s
    /// @param speed component of the velocity against the force, m/s
    /// @param mobility change of the speed per impulse, 1/kg
    double
    braking_impulse(const double impulse,
                    const double speed,
                    const double mobility)
    {
      return speed > 0 ? impulse / (1. + mobility * impulse / speed) : 0.;
    }
  } // namespace



  /// Impulse of the water on a facet in a step, N s: friction along the facet,
  /// and pressure where the facet moves into the water. The pressure acts on
  /// the vector area, so that the pressures on a closed surface balance.
  template <int dim>
  Tensor<1, dim>
  Water<dim>::drag_impulse(const SurfaceFacet<dim> &facet,
                           const double             dt) const
  {
    const double         area       = facet.vector_area * facet.normal;
    const double         outwards   = facet.velocity * facet.normal;
    const Tensor<1, dim> tangential = facet.velocity - outwards * facet.normal;
    const double         speed      = tangential.norm();
    const double         size       = facet.vector_area.norm();
    const double         factor     = 0.5 * density_ * dt;
    Tensor<1, dim>       impulse;
    if (speed > 0)
      impulse -= braking_impulse(factor * skin_friction_ * area * speed * speed,
                                 speed,
                                 facet.mobility) /
                 speed * tangential;
    if (outwards > 0)
      impulse -=
        braking_impulse(factor * pressure_drag_ * size * outwards * outwards,
                        facet.velocity * facet.vector_area / size,
                        facet.mobility) /
        size * facet.vector_area;
    return impulse;
  }



  template <int dim>
  Tensor<1, dim>
  Water<dim>::impulse_at(const unsigned int node) const
  {
    Tensor<1, dim> impulse;
    for (unsigned int d = 0; d < dim; ++d)
      impulse[d] = impulses_[std::size_t(dim) * node + d];
    return impulse;
  }



  /// Sum the impulses of all facets at their nodes.
  template <int dim>
  void
  Water<dim>::find_impulses(const State<dim> &state)
  {
    surface_.update_soil(state);
    for (const unsigned int node : surface_.nodes_of_facets())
      std::fill_n(impulses_.begin() + std::size_t(dim) * node, dim, 0.);
    for (const SurfaceFacet<dim> &facet : surface_.facets())
      {
        const Tensor<1, dim> impulse = drag_impulse(facet, state.time_step);
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          for (unsigned int d = 0; d < dim; ++d)
            impulses_[std::size_t(dim) * facet.node[v] + d] +=
              facet.share[v] * impulse[d];
      }
    surface_.pass_to_masters(impulses_);
    exchange_of_impulses_.add_to_owners(impulses_.data());
  }



  // The drag acts after the forces, on the velocities that they give: what it
  // removes is exactly the loss of kinetic energy at the nodes. With the mean
  // velocity of the step, as for forces, soil that other forces reverse in the
  // step would seem to gain energy by drag.
  /// Brake the soil at the free surface, and record energy and impulse.
  template <int dim>
  void
  Water<dim>::correct_velocities(State<dim> &state)
  {
    if (!acts())
      return;
    find_impulses(state);
    NodalFields<dim> &nodes = state.nodes;
    Tensor<1, dim>   &total = state.accounts.impulse("drag impulse");
    double            work  = 0;
    for (const unsigned int node : surface_.nodes_of_facets())
      {
        const Tensor<1, dim> impulse = impulse_at(node);
        if (node >= state.grid.n_owned_nodes() || impulse == Tensor<1, dim>())
          continue;
        const Tensor<1, dim> before = nodes.velocity(node);
        const Tensor<1, dim> after  = before + impulse / nodes.mass(node);
        nodes.set_velocity(node, after);
        work -= 0.5 * impulse * (before + after);
        total += impulse;
      }
    TalusAssert(Utilities::MPI::sum(work, state.communicator()) >= 0,
                ExcMessage("The drag of the water added energy to the soil."));
    state.accounts.energy("drag work") += work;
  }



  // The Froude number belongs to the whole slide: mean velocity, and volume of
  // the soil divided by the area of the free surface projected along y, with
  // the component of gravity along -y.
  template <int dim>
  void
  Water<dim>::list_quantities(const State<dim> &state, Quantities &list) const
  {
    if (!acts())
      return;
    const Points<dim> &points = state.points;
    double             mass = 0, volume = 0, covered = 0;
    Tensor<1, dim>     momentum, added_momentum;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double         m = points.data(points.mass)[p];
        const Tensor<1, dim> v = load_place(points, points.velocity, p);
        const double         added =
          m * state.constants.added_mass[points.data(points.body)[p]];
        mass += m;
        volume += points.data(points.reference_volume)[p];
        momentum += m * v;
        added_momentum += added * v;
      }
    for (const SurfaceFacet<dim> &facet : surface_.facets())
      covered += std::max(0., facet.vector_area[1]);

    const MPI_Comm comm = state.communicator();
    const auto     sum  = [comm](const auto &value) {
      return Utilities::MPI::sum(value, comm);
    };
    mass = sum(mass), volume = sum(volume), covered = sum(covered);
    momentum = sum(momentum), added_momentum = sum(added_momentum);
    const Tensor<1, dim> impulse = sum(state.accounts.impulse("drag impulse"));
    append_vector<dim>(list, "drag impulse", "N s", impulse);
    append_vector<dim>(list, "added mass momentum", "kg m/s", added_momentum);
    const double lightness =
      -(mass / volume / density_ - 1.) * state.constants.gravity[1];
    list.push_back(
      {"densimetric Froude number",
       "",
       covered > 0 && lightness > 0
         ? momentum.norm() / mass / std::sqrt(lightness * volume / covered)
         : 0.});
  }



  template class Water<2>;
  template class Water<3>;
} // namespace talus
