// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/contact_constraints.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  ContactConstraints<dim>::prepare()
  {
    constraints_.clear();
    loaded_.clear();
    loaded_nodes_.clear();
  }



  // Facets of moving obstacles may have changed since the last step, and so the
  // numbers of all places.
  template <int dim>
  void
  ContactConstraints<dim>::begin_step()
  {
    const unsigned int n = place_of_node(face_nodes_.size());
    if (obstacles_.move() || constraints_.size() != n)
      constraints_.assign(n, {});
    else
      {
        for (const unsigned int c : loaded_)
          constraints_[c] = {};
        for (const unsigned int i : loaded_nodes_)
          constraints_[place_of_node(i)] = {};
      }
    loaded_.clear();
    loaded_nodes_.clear();
  }



  template <int dim>
  void
  ContactConstraints<dim>::find(const State<dim> &state, const bool has_memory)
  {
    for (unsigned int c = 0; c < facets_.owned().size(); ++c)
      {
        const ContactFacet<dim> &facet      = facets_.owned()[c];
        ContactConstraint<dim>  &constraint = constraints_[c];
        if (soil_.fraction(c) == 0 || !find_shares(facet, constraint))
          continue;
        loaded_.push_back(c);
        require_uniform(facet);
        find_masses(facet, constraint);
        constraint.area = facet.area * soil_.share(c);
        constraint.pore_force =
          constraint.area * soil_.pore_pressure(facet, constraint.share);
        if (has_memory)
          constraint.averaging_weight =
            averaging_weight(state, facet, constraint);
      }
  }



  template <int dim>
  void
  ContactConstraints<dim>::find_at_node(const State<dim>  &state,
                                        const unsigned int i,
                                        const bool         has_memory)
  {
    const FaceNode<dim>    &at         = face_nodes_[i];
    ContactConstraint<dim> &constraint = constraints_[place_of_node(i)];
    loaded_nodes_.push_back(i);
    constraint.is_loaded = true;
    constraint.share[0]  = 1.;
    constraint.mass = constraint.normal_mass = state.nodes.mass(at.node);
    constraint.gap                           = soil_.gap(at);
    constraint.area       = soil_.area_in_contact(state.nodes, at);
    constraint.pore_force = constraint.area * soil_.pore_pressure(at);
    if (has_memory)
      {
        Tensor<1, dim> slip = state.time_step * state.nodes.velocity(at.node);
        slip[at.face / 2]   = 0;
        constraint.averaging_weight =
          InterfaceFriction::averaging_weight(slip.norm(), at.cell_size());
      }
  }



  /// Compute the shares of the nodes; return whether the facet has soil. A
  /// share is proportional to shape function times volume fraction: a node with
  /// hardly any soil must not decide how the soil at the facet moves. Shares by
  /// mass would shift the wall into the soil.
  template <int dim>
  bool
  ContactConstraints<dim>::find_shares(const ContactFacet<dim> &facet,
                                       ContactConstraint<dim> &constraint) const
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
  ContactConstraints<dim>::require_uniform(const ContactFacet<dim> &facet) const
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
  ContactConstraints<dim>::find_masses(const ContactFacet<dim> &facet,
                                       ContactConstraint<dim> &constraint) const
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
  ContactConstraints<dim>::averaging_weight(
    const State<dim>             &state,
    const ContactFacet<dim>      &facet,
    const ContactConstraint<dim> &constraint) const
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
  ContactConstraints<dim>::velocity(
    const ContactFacet<dim>      &facet,
    const ContactConstraint<dim> &constraint) const
  {
    Tensor<1, dim> u;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      u += constraint.share[v] * nodes_.velocity(facet.node[v]);
    return u;
  }



  template <int dim>
  CoulombLimit
  ContactConstraints<dim>::limit(const unsigned int place) const
  {
    const auto        &facets = facets_.owned();
    const unsigned int n      = facets.size();
    CoulombLimit       result =
      bed(place).limit(place < n ? facets[place].maximum_shear_stress
                                 : face_nodes_.maximum_shear_stress(place - n),
                       constraints_[place].area,
                       slip_.places().empty() ? SurfaceState()
                                              : slip_.state(place));
    result.pore_force = constraints_[place].pore_force;
    return result;
  }



  template <int dim>
  double
  ContactConstraints<dim>::friction_impulse(const unsigned int place,
                                            const double       trial,
                                            const double       normal_impulse,
                                            const double       dt) const
  {
    return limit(place).impulse(trial,
                                constraints_[place].mass,
                                normal_impulse / dt,
                                dt);
  }



  template class ContactConstraints<2>;
  template class ContactConstraints<3>;
} // namespace talus
