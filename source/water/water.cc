// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/water/water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Water<dim>::Water(const Materials<dim>    &materials,
                    const FacetContact<dim> &contact)
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
    exchange_of_forces_.prepare(grid, dim);
    forces_.assign(std::size_t(dim) * grid.n_nodes(), 0.);
  }



  /// The facets stay where they are until soil may have moved by a tenth of a
  /// cell: the search for the free surface takes as long as the transfer of all
  /// points, and the drag is hardly affected (doc/performance.md, "Water").
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
    surface_.update_soil(state);
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
    list.add_table(
      {"free surface",
       "key of the cell: upper and lower 32 bits; vector area [m^(dim-1)]; "
       "normal [-]",
       FreeSurface<dim>::n_columns,
       [this]() { return surface_.rows(); },
       [this](const std::vector<double> &rows) { surface_.restore(rows); }});
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



  /// Force of the water on a facet, N: friction along the facet, and pressure
  /// where the facet moves into the water. The pressure acts on the vector
  /// area, so that the pressures on a closed surface balance.
  template <int dim>
  Tensor<1, dim>
  Water<dim>::drag(const SurfaceFacet<dim> &facet) const
  {
    const double         area       = facet.vector_area * facet.normal;
    const double         outwards   = facet.velocity * facet.normal;
    const Tensor<1, dim> tangential = facet.velocity - outwards * facet.normal;
    const Tensor<1, dim> friction =
      skin_friction_ * area * tangential.norm() * tangential;
    const double pressure =
      pressure_drag_ * std::pow(std::max(0., outwards), 2);
    return -0.5 * density_ * (friction + pressure * facet.vector_area);
  }



  template <int dim>
  Tensor<1, dim>
  Water<dim>::force_at(const unsigned int node) const
  {
    Tensor<1, dim> force;
    for (unsigned int d = 0; d < dim; ++d)
      force[d] = forces_[std::size_t(dim) * node + d];
    return force;
  }



  template <int dim>
  void
  Water<dim>::add_forces(State<dim> &state)
  {
    if (!acts())
      return;
    const auto add = [this](const unsigned int    node,
                            const Tensor<1, dim> &force) {
      for (unsigned int d = 0; d < dim; ++d)
        forces_[std::size_t(dim) * node + d] += force[d];
    };
    for (const SurfaceFacet<dim> &facet : surface_.facets())
      {
        const Tensor<1, dim> force = drag(facet);
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          add(facet.node[v], facet.share[v] * force);
      }
    for (const HangingNode *const hanging : surface_.hanging_nodes_of_facets())
      {
        const Tensor<1, dim> force = force_at(hanging->node);
        for (const auto &[master, weight] : hanging->masters)
          add(master, weight * force);
        add(hanging->node, -force);
      }
    exchange_of_forces_.add_to_owners(forces_.data());
    for (const unsigned int node : surface_.nodes_of_facets())
      if (node < state.grid.n_owned_nodes())
        state.nodes.add_force(node, force_at(node));
  }



  template <int dim>
  void
  Water<dim>::record(State<dim> &state)
  {
    if (!acts())
      return;
    const double    dt    = state.time_step;
    double         &work  = state.accounts.energy("drag work");
    Tensor<1, dim> &total = state.accounts.impulse("drag impulse");
    for (const unsigned int node : state.nodes.active_nodes())
      {
        const Tensor<1, dim> force = force_at(node);
        if (force == Tensor<1, dim>())
          continue;
        const Tensor<1, dim> impulse = dt * force;
        work -= impulse * state.nodes.mean_velocity(node);
        total += impulse;
      }
    for (const unsigned int node : surface_.nodes_of_facets())
      std::fill_n(forces_.begin() + std::size_t(dim) * node, dim, 0.);
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
