// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/contact_nodes.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  ContactNodes<dim>::prepare(const Grid<dim> &grid)
  {
    exchange_of_records_.prepare(grid, width);
    exchange_of_impulses_.prepare(grid, dim);
    records_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    impulses_.assign(std::size_t(dim) * grid.n_nodes(), 0.);
    totals_.assign(std::size_t(dim) * grid.n_nodes(), 0.);
    held_.assign(grid.n_nodes(), 0);
    active_.clear();
  }



  template <int dim>
  void
  ContactNodes<dim>::hold_walls(State<dim> &state, Boundaries<dim> &boundaries)
  {
    for (const unsigned int node : facets_.nodes_on_faces())
      held_[node] = boundaries.components_constrained_by_walls(
        state.grid.faces_of_node(node));
    BoundaryWork<dim> work;
    for (const unsigned int node : facets_.owned_nodes_on_faces())
      if (held_[node] && state.nodes.mass(node) > state.constants.mass_cutoff)
        boundaries.impose_walls(state, node, work);
    work.record(state.accounts);
  }



  /// Records of nodes without soil stay zero.
  template <int dim>
  void
  ContactNodes<dim>::load(const State<dim> &state)
  {
    const NodalFields<dim> &nodes = state.nodes;
    for (const unsigned int node : active_)
      {
        std::fill_n(records_.begin() + std::size_t(width) * node, width, 0.);
        std::fill_n(totals_.begin() + std::size_t(dim) * node, dim, 0.);
      }
    active_.clear();
    masses_.clear();
    for (const unsigned int node : facets_.owned_nodes())
      {
        const double mass = nodes.mass(node);
        if (mass <= state.constants.mass_cutoff ||
            facets_.open_volume(node) <= 0)
          continue;
        active_.push_back(node);
        masses_.push_back(mass);
        double *const record = records_.data() + std::size_t(width) * node;
        record[splitting]    = facets_.n_facets(node) / mass;
        for (unsigned int d = 0; d < dim; ++d)
          record[moving + d] = nodes.velocity(node)[d];
      }
    exchange_of_records_.copy_to_ghosts(records_.data());
  }



  template <int dim>
  void
  ContactNodes<dim>::update_velocities(const bool for_ghosts)
  {
    exchange_of_impulses_.add_to_owners(impulses_.data());
    for (std::size_t i = 0; i < active_.size(); ++i)
      {
        const unsigned int node    = active_[i];
        double *const      impulse = impulses_.data() + std::size_t(dim) * node;
        double *const      record = records_.data() + std::size_t(width) * node;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (!is_held(node, d))
              record[moving + d] += impulse[d] / masses_[i];
            totals_[std::size_t(dim) * node + d] += impulse[d];
            impulse[d] = 0;
          }
      }
    if (for_ghosts)
      exchange_of_records_.copy_to_ghosts(records_.data());
  }



  template <int dim>
  void
  ContactNodes<dim>::write(State<dim> &state) const
  {
    for (const unsigned int node : active_)
      state.nodes.set_velocity(node, velocity(node));
  }



  template <int dim>
  void
  ContactNodes<dim>::record_walls(State<dim>      &state,
                                  Boundaries<dim> &boundaries) const
  {
    BoundaryWork<dim> work;
    for (const unsigned int node : facets_.owned_nodes_on_faces())
      if (held_[node])
        {
          Tensor<1, dim> taken_up;
          for (unsigned int d = 0; d < dim; ++d)
            if (is_held(node, d))
              taken_up[d] = -totals_[std::size_t(dim) * node + d];
          boundaries.record_walls(state, node, taken_up, work);
        }
    work.record(state.accounts);
  }



  template class ContactNodes<2>;
  template class ContactNodes<3>;
} // namespace talus
