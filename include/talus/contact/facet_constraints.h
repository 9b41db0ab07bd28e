// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_constraints_h
#define talus_contact_facet_constraints_h

#include <talus/contact/contact_nodes.h>
#include <talus/contact/facet_coverage.h>
#include <talus/contact/facets.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// A facet with the soil as it is: shares of its nodes in its velocity, and so
  /// on.
  template <int dim>
  struct FacetConstraint
  {
    std::array<double, ContactFacet<dim>::n_nodes> share{};
    bool   is_loaded   = false; ///< whether there is soil at its nodes
    double normal_mass = 0;     ///< kg; 0 where walls hold all nodes
    double mass        = 0;     ///< kg
    double gap         = 0;     ///< m
    double area        = 0;     ///< in contact, m^(dim-1)
    /// Weight of the normal impulse of this step in the running mean that limits
    /// friction [-].
    double averaging_weight = 1;
  };



  /// Those of all facets of this rank: the mean velocity of the soil at the
  /// contact point must not lead into the obstacle.
  template <int dim>
  class FacetConstraints
  {
  public:
    FacetConstraints(const Obstacles<dim>    &obstacles,
                     const Facets<dim>       &facets,
                     const ContactNodes<dim> &nodes)
      : obstacles_(obstacles)
      , facets_(facets)
      , nodes_(nodes)
    {}

    /// After each change of the mesh or its partition. There are none until
    /// find(). Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Find how near soil comes to the surfaces; before find(). Collective.
    void
    find_gaps(const State<dim> &state);

    /// Find those of Facets::owned() for soil as the nodes have it, whose
    /// friction remembers earlier steps if it @p has_memory.
    void
    find(const State<dim> &state, bool has_memory);

    /// Of Facets::owned(), as find() left them.
    const std::vector<FacetConstraint<dim>> &
    all() const
    {
      return constraints_;
    }

    const FacetConstraint<dim> &
    operator[](const unsigned int facet) const
    {
      return constraints_[facet];
    }

    /// Numbers of the facets with soil at their nodes.
    const std::vector<unsigned int> &
    loaded() const
    {
      return loaded_;
    }

    /// Velocity of the soil at the contact point, m/s.
    dealii::Tensor<1, dim>
    velocity(unsigned int facet) const
    {
      return velocity(facets_.owned()[facet], constraints_[facet]);
    }

    /// Friction impulse that a facet passes at most to soil at rest in a step of
    /// @p dt s, N s, for an impulse along the normal, N s.
    double
    friction_limit(unsigned int facet, double normal_impulse, double dt) const;

    /// Length of the tangential impulse of a facet in a step of @p dt s, N s, for
    /// an impulse along the normal, N s, if @p trial would stop the soil, N s.
    double
    friction_impulse(unsigned int facet,
                     double       trial,
                     double       normal_impulse,
                     double       dt) const;

    /// Room between such a node's soil and the obstacle, m.
    double
    gap_inside(const Grid<dim>                        &grid,
               const typename Facets<dim>::NodeInside &inside) const
    {
      return gaps_.room(inside.node, inside.obstacle, grid.finest_size());
    }

  private:
    void
    prepare_gaps(const Grid<dim> &grid, std::vector<unsigned int> slots);
    std::vector<typename NodalGaps<dim>::Surface>
    surfaces() const;
    std::vector<unsigned int>
    slots(const Grid<dim> &grid) const;
    bool
    find_shares(const ContactFacet<dim> &facet,
                FacetConstraint<dim>    &constraint) const;
    void
    require_uniform(const Cell<dim>         &cell,
                    const ContactFacet<dim> &facet) const;
    void
    find_masses(const ContactFacet<dim> &facet,
                double                   cell_size,
                FacetConstraint<dim>    &constraint) const;
    double
    averaging_weight(const State<dim>           &state,
                     const ContactFacet<dim>    &facet,
                     const FacetConstraint<dim> &constraint) const;
    double
    volume_fraction(const ContactFacet<dim> &facet) const;
    dealii::Tensor<1, dim>
    velocity(const ContactFacet<dim>    &facet,
             const FacetConstraint<dim> &constraint) const;

    const Obstacles<dim>             &obstacles_;
    const Facets<dim>                &facets_;
    const ContactNodes<dim>          &nodes_;
    NodalGaps<dim>                    gaps_; ///< the obstacles' surfaces
    FacetCoverage<dim>                coverage_{obstacles_, facets_};
    std::vector<FacetConstraint<dim>> constraints_;
    std::vector<unsigned int>         loaded_;
  };
} // namespace talus

#endif
