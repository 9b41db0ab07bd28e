// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_contact_nodes_h
#define talus_contact_contact_nodes_h

#include <talus/boundaries/boundaries.h>
#include <talus/contact/facets.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Nodes that touch facets, during the iteration for the impulses:
  /// velocities, and impulses of facets and walls in a step.
  template <int dim>
  class ContactNodes
  {
  public:
    explicit ContactNodes(const Facets<dim> &facets)
      : facets_(facets)
    {}

    /// Call after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid);

    /// Apply walls: give the nodes the velocities prescribed by walls, and
    /// store which components are held. Facets cannot change held components.
    void
    hold_walls(State<dim> &state, Boundaries<dim> &boundaries);

    /// Read masses and velocities after the momentum update. Collective.
    void
    load(const State<dim> &state);

    /// Number of facets at a node divided by the mass of the node, 1/kg; also
    /// for ghosts. Each facet gets an equal part of the mass.
    double
    inverse_mass(const unsigned int node) const
    {
      return records_[std::size_t(width) * node + splitting];
    }

    /// Velocity of a node in the iteration, m/s; also for ghosts.
    dealii::Tensor<1, dim>
    velocity(const unsigned int node) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = records_[std::size_t(width) * node + moving + d];
      return result;
    }

    bool
    is_held(const unsigned int node, const unsigned int component) const
    {
      return held_[node] & (1u << component);
    }

    /// Add an impulse, N s, which acts in the next update_velocities().
    void
    add_impulse(const unsigned int node, const dealii::Tensor<1, dim> &impulse)
    {
      for (unsigned int d = 0; d < dim; ++d)
        impulses_[std::size_t(dim) * node + d] += impulse[d];
    }

    /// Apply the added impulses to the velocities. Components held by walls do
    /// not change: the wall bears the impulse. Without @p for_ghosts ghosts
    /// keep the previous velocities. Collective.
    void
    update_velocities(bool for_ghosts = true);

    /// Copy the velocities to the nodes of @p state.
    void
    write(State<dim> &state) const;

    /// Record the reactions of walls to facet impulses on held components.
    void
    record_walls(State<dim> &state, Boundaries<dim> &boundaries) const;

  private:
    // Record of a node, for messages: number of facets per mass [1/kg],
    // velocity [m/s].
    enum Record
    {
      splitting,
      moving,
      width = moving + dim
    };

    const Facets<dim>         &facets_;
    std::vector<unsigned int>  active_;   ///< owned nodes with soil
    std::vector<double>        masses_;   ///< by entry of active_, kg
    std::vector<double>        records_;  ///< see Record
    std::vector<double>        impulses_; ///< in a sweep, N s
    std::vector<double>        totals_;   ///< in the step, N s
    std::vector<unsigned char> held_;     ///< components, by node
    NodalExchange<dim>         exchange_of_records_, exchange_of_impulses_;
  };
} // namespace talus

#endif
