// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/contact_area.h>
#include <talus/contact/facet_constraints.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  FacetConstraints<dim>::prepare(const Grid<dim> &grid)
  {
    prepare_gaps(grid, slots(grid));
    coverage_.prepare(grid);
    constraints_.clear();
    loaded_.clear();
  }



  template <int dim>
  void
  FacetConstraints<dim>::prepare_gaps(const Grid<dim>          &grid,
                                      std::vector<unsigned int> slots)
  {
    using Plane = typename NodalGaps<dim>::Plane;
    gaps_.prepare(
      grid,
      surfaces(),
      std::move(slots),
      [this](const Point<dim> &x, const double distance) {
        return obstacles_.near(x, distance);
      },
      [this](const unsigned int cell) {
        const ContactFacet<dim> *const facet = facets_.flat_facet(cell);
        return facet ? std::optional<Plane>(
                         {facet->obstacle, facet->centroid, facet->normal})
                     : std::nullopt;
      },
      [this, &grid](const unsigned int cell) {
        const ContactFacet<dim> *const facet = facets_.only_surface(cell);
        return facet ? std::make_pair(tables_.table(grid.cells()[cell], *facet),
                                      facet->obstacle)
                     : std::make_pair<const SurfaceTable<dim> *, unsigned int>(
                         nullptr, 0);
      });
  }



  // Moving obstacles may have come near to others since the last step.
  template <int dim>
  void
  FacetConstraints<dim>::find_gaps(const State<dim> &state)
  {
    if (obstacles_.move())
      if (auto slots_now = slots(state.grid); slots_now != gaps_.slots())
        prepare_gaps(state.grid, std::move(slots_now));
    tables_.limit(state.points.size());
    gaps_.find(state,
               facets_.nodes_and_obstacles(),
               facets_.nearness_of_cells());
  }



  // Distance of a box: distance of the centre less the support of the box.
  template <int dim>
  std::vector<typename NodalGaps<dim>::Surface>
  FacetConstraints<dim>::surfaces() const
  {
    std::vector<typename NodalGaps<dim>::Surface> result;
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      result.push_back([&obstacle = obstacles_[k]](const Point<dim>     &x,
                                                   const Tensor<1, dim> &half) {
        auto [gap, normal] = obstacle.distance_and_normal(x);
        for (unsigned int d = 0; d < dim; ++d)
          gap -= half[d] * std::abs(normal[d]);
        return gap;
      });
    return result;
  }



  /// Return the slot of each obstacle, the same on all ranks. Obstacles far
  /// apart share a slot: the number of slots follows the density of the
  /// obstacles. Collective.
  template <int dim>
  std::vector<unsigned int>
  FacetConstraints<dim>::slots(const Grid<dim> &grid) const
  {
    double largest_cell = 0;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      if (facets_.is_near(c))
        largest_cell = std::max(largest_cell, grid.cells()[c].size);
    const double distance = NodalGaps<dim>::min_distance_in_slot(
      Utilities::MPI::max(largest_cell, grid.communicator()));
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      {
        const auto near =
          obstacles_.near(obstacles_[k].bounding_box(), distance);
        std::vector<unsigned char> is_taken(near.size() + 1, 0);
        for (const unsigned int other : near)
          if (other < k && result[other] < is_taken.size())
            is_taken[result[other]] = 1;
        result.push_back(std::find(is_taken.begin(), is_taken.end(), 0) -
                         is_taken.begin());
      }
    return result;
  }



  template <int dim>
  void
  FacetConstraints<dim>::find(const State<dim> &state, const bool has_memory)
  {
    for (const unsigned int c : loaded_)
      constraints_[c] = {};
    loaded_.clear();
    constraints_.resize(facets_.owned().size());
    find_volume_fractions(facets_.owned(), fractions_);
    find_volume_fractions(facets_.ghosts(), fractions_of_ghosts_);
    coverage_.find(state, fractions_, fractions_of_ghosts_);
    for (unsigned int c = 0; c < constraints_.size(); ++c)
      {
        const ContactFacet<dim> &facet      = facets_.owned()[c];
        FacetConstraint<dim>    &constraint = constraints_[c];
        if (fractions_[c] == 0 || !find_shares(facet, constraint))
          continue;
        loaded_.push_back(c);
        require_uniform(facet);
        find_masses(facet, constraint);
        constraint.area =
          facet.area * share_in_contact(coverage_[c], fractions_[c]);
        if (has_memory)
          constraint.averaging_weight =
            averaging_weight(state, facet, constraint);
      }
  }



  template <int dim>
  void
  FacetConstraints<dim>::find_volume_fractions(
    const std::vector<ContactFacet<dim>> &facets,
    std::vector<double>                  &fractions) const
  {
    fractions.assign(facets.size(), 0.);
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        const ContactFacet<dim> &facet = facets[f];
        double                   sum   = 0;
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          sum += facet.shape_value[v] * nodes_.fill(facet.node[v]);
        fractions[f] = sum;
      }
  }



  /// Compute the shares of the nodes; return whether the facet has soil. A
  /// share is proportional to shape function times volume fraction: a node with
  /// hardly any soil must not decide how the soil at the facet moves. Shares by
  /// mass would shift the wall into the soil.
  template <int dim>
  bool
  FacetConstraints<dim>::find_shares(const ContactFacet<dim> &facet,
                                     FacetConstraint<dim>    &constraint) const
  {
    std::array<double, ContactFacet<dim>::n_nodes> share;
    double                                         sum = 0;
    for (unsigned int v = 0; v < share.size(); ++v)
      {
        share[v] = facet.shape_value[v] * nodes_.fill(facet.node[v]);
        sum += share[v];
      }
    if (sum <= 0)
      return false;
    for (unsigned int v = 0; v < share.size(); ++v)
      constraint.share[v] = share[v] / sum;
    constraint.is_loaded = true;
    return true;
  }



  template <int dim>
  void
  FacetConstraints<dim>::require_uniform(const ContactFacet<dim> &facet) const
  {
    AssertThrow(facet.cell_is_uniform,
                ExcPoint(text("Soil has come to the surface of the obstacle '",
                              obstacles_[facet.obstacle].name(),
                              "' at (",
                              facet.centroid,
                              ") m, where cells of different size meet; "
                              "contact needs cells of one size. Let "
                              "'Grid/Refinement boxes' cover the surface as "
                              "far as soil may come, or leave more cells in "
                              "'Mesh tracking' around the soil.")));
  }



  /// Compute the effective masses of a facet and the gap, the smallest gap of
  /// the nodes with soil.
  template <int dim>
  void
  FacetConstraints<dim>::find_masses(const ContactFacet<dim> &facet,
                                     FacetConstraint<dim>    &constraint) const
  {
    double inverse_mass = 0, inverse_normal_mass = 0;
    constraint.gap = NodalGaps<dim>::none;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      {
        const unsigned int node  = facet.node[v];
        const double       share = constraint.share[v];
        if (share == 0)
          continue;
        const double inverse = share * share * nodes_.inverse_mass(node);
        double       free    = 1.; // share of the normal not held by walls
        for (unsigned int d = 0; d < dim; ++d)
          if (nodes_.is_held(node, d))
            free -= facet.normal[d] * facet.normal[d];
        inverse_mass += inverse;
        inverse_normal_mass += free * inverse;
        static const bool mean = getenv("T_M");
        if (mean)
          constraint.gap = (v==0||constraint.gap==NodalGaps<dim>::none?0:constraint.gap) + share*gaps_.room(node, facet.obstacle, facet.cell_size);
        else
        constraint.gap =
          std::min(constraint.gap,
                   gaps_.room(node, facet.obstacle, facet.cell_size));
      }
    constraint.mass = 1. / inverse_mass;
    constraint.normal_mass =
      (inverse_normal_mass > 1e-6 * inverse_mass ? 1. / inverse_normal_mass
                                                 : 0.);
  }



  // Impulses are averaged, not pressures: the sum of the impulses, and so the
  // mean force, is kept while soil slides from facet to facet.
  template <int dim>
  double
  FacetConstraints<dim>::averaging_weight(
    const State<dim>           &state,
    const ContactFacet<dim>    &facet,
    const FacetConstraint<dim> &constraint) const
  {
    const double         dt = state.time_step;
    const Tensor<1, dim> u =
      velocity(facet, constraint) -
      obstacles_[facet.obstacle].velocity_at(facet.centroid,
                                             state.time + 0.5 * dt);
    const double slip = (u - (u * facet.normal) * facet.normal).norm() * dt;
    return InterfaceFriction::averaging_weight(slip, facet.cell_size);
  }



  template <int dim>
  Tensor<1, dim>
  FacetConstraints<dim>::velocity(const ContactFacet<dim>    &facet,
                                  const FacetConstraint<dim> &constraint) const
  {
    Tensor<1, dim> u;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      u += constraint.share[v] * nodes_.velocity(facet.node[v]);
    return u;
  }



  template <int dim>
  CoulombLimit
  FacetConstraints<dim>::limit(const unsigned int facet) const
  {
    const ContactFacet<dim> &at = facets_.owned()[facet];
    return obstacles_[at.obstacle].friction().limit(at.maximum_shear_stress,
                                                    constraints_[facet].area,
                                                    slip_.places().empty()
                                                      ? SurfaceState()
                                                      : slip_.state(facet));
  }



  template <int dim>
  double
  FacetConstraints<dim>::friction_limit(const unsigned int facet,
                                        const double       normal_impulse,
                                        const double       dt) const
  {
    return dt * limit(facet).force(normal_impulse / dt);
  }



  template <int dim>
  double
  FacetConstraints<dim>::friction_impulse(const unsigned int facet,
                                          const double       trial,
                                          const double       normal_impulse,
                                          const double       dt) const
  {
    const FacetConstraint<dim> &constraint = constraints_[facet];
    return obstacles_[facets_.owned()[facet].obstacle].friction().impulse(
      trial,
      constraint.mass,
      friction_limit(facet, normal_impulse, dt) / dt,
      constraint.area,
      dt);
  }



  template class FacetConstraints<2>;
  template class FacetConstraints<3>;
} // namespace talus
