// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_contact_nodes_h
#define talus_contact_contact_nodes_h

#include <talus/boundaries/boundaries.h>
#include <talus/contact/facets.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// The nodes that touch facets, while the impulses of these are sought: their
  /// velocities, and what facets and walls do to them in a step.
  template <int dim>
  class ContactNodes
  {
  public:
    explicit ContactNodes(const Facets<dim> &facets)
      : facets_(facets)
    {}

    /// After each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid);

    /// Give nodes that walls hold or drive their velocity; remember which
    /// components, which no facet can change.
    void
    hold_walls(State<dim> &state, Boundaries<dim> &boundaries);

    /// Take the velocities after the momentum update, and how much of the room
    /// at a node the soil fills. Collective.
    void
    load(const State<dim> &state);

    /// Share of the room that obstacles leave at a node which soil fills, ghosts
    /// too.
    double
    fill(const unsigned int node) const
    {
      return records_[std::size_t(width) * node + filling];
    }

    /// One over the mass that each of its facets may take, 1/kg, ghosts too.
    double
    inverse_mass(const unsigned int node) const
    {
      return records_[std::size_t(width) * node + splitting];
    }

    /// m/s, ghosts too.
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

    /// To act with the next update_velocities(), N s.
    void
    add_impulse(const unsigned int node, const dealii::Tensor<1, dim> &impulse)
    {
      for (unsigned int d = 0; d < dim; ++d)
        impulses_[std::size_t(dim) * node + d] += impulse[d];
    }

    /// Components that walls hold do not move: the wall takes the impulse up.
    /// Collective.
    void
    update_velocities(const State<dim> &state);

    /// Give the velocities to the nodes of @p state.
    void
    write(State<dim> &state) const;

    /// Walls take up what facets did to the components that they hold.
    void
    record_walls(State<dim> &state, Boundaries<dim> &boundaries) const;

  private:
    // By node, for exchange: degree of filling [-], number of facets over mass
    // [1/kg], and velocity [m/s].
    enum Record
    {
      filling,
      splitting,
      moving,
      width = moving + dim
    };

    const Facets<dim>         &facets_;
    std::vector<unsigned int>  active_;   ///< owned ones with soil
    std::vector<double>        records_;  ///< see Record
    std::vector<double>        impulses_; ///< of a sweep, N s
    std::vector<double>        totals_;   ///< of the step, N s
    std::vector<unsigned char> held_;     ///< components, by node
    NodalExchange<dim>         exchange_of_records_, exchange_of_impulses_;
  };
} // namespace talus

#endif
