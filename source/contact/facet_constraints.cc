// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/facet_constraints.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  FacetConstraints<dim>::prepare()
  {
    constraints_.clear();
    loaded_.clear();
  }



  template <int dim>
  void
  FacetConstraints<dim>::find(const State<dim> &state, const bool has_memory)
  {
    for (const unsigned int c : loaded_)
      constraints_[c] = {};
    loaded_.clear();
    constraints_.resize(facets_.owned().size());
    for (unsigned int c = 0; c < constraints_.size(); ++c)
      {
        const ContactFacet<dim> &facet      = facets_.owned()[c];
        FacetConstraint<dim>    &constraint = constraints_[c];
        if (soil_.fraction(c) == 0 || !find_shares(facet, constraint))
          continue;
        loaded_.push_back(c);
        require_uniform(facet);
        find_masses(facet, constraint);
        constraint.area = facet.area * soil_.share(c);
        if (has_memory)
          constraint.averaging_weight =
            averaging_weight(state, facet, constraint);
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
        share[v] = facet.shape_value[v] * soil_.volume_fraction(facet.node[v]);
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
        constraint.gap =
          std::min(constraint.gap,
                   soil_.gap(node, facet.obstacle, facet.cell_size));
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
    return obstacles_[at.obstacle].bed().limit(at.maximum_shear_stress,
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
    return obstacles_[facets_.owned()[facet].obstacle].bed().impulse(
      trial,
      constraint.mass,
      friction_limit(facet, normal_impulse, dt) / dt,
      constraint.area,
      dt);
  }



  template class FacetConstraints<2>;
  template class FacetConstraints<3>;
} // namespace talus
