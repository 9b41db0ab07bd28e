// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_contact_constraints_h
#define talus_contact_contact_constraints_h

#include <talus/boundaries/bed_slip.h>
#include <talus/contact/contact_nodes.h>
#include <talus/contact/face_nodes.h>
#include <talus/contact/facets.h>
#include <talus/contact/soil_at_places.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Soil at a facet, or at a node of a seabed face, in the current step. A
  /// place without soil keeps the default values.
  template <int dim>
  struct ContactConstraint
  {
    /// Weights of the nodes in the velocity at the facet [-]; sum 1.
    std::array<double, ContactFacet<dim>::n_nodes> share{};
    bool   is_loaded   = false; ///< whether the nodes of the facet have soil
    double normal_mass = 0; ///< along the normal, kg; 0: walls hold all nodes
    double mass        = 0; ///< effective mass without walls, kg
    double gap         = 0; ///< between soil and surface, m, >= 0
    double area        = 0; ///< in contact, m^(dim-1)
    double pore_force  = 0; ///< force of excess pore pressure, N
    /// Weight of the current normal impulse in the running mean [-].
    double averaging_weight = 1;
  };



  /// Constraints of all places of contact: the facets in owned cells, followed
  /// by FaceNodes. The mean velocity of the soil at a place must not lead into
  /// the surface. Computes effective mass, gap, area in contact and limit of
  /// friction; Contact computes the impulses.
  template <int dim>
  class ContactConstraints
  {
  public:
    ContactConstraints(const Obstacles<dim>    &obstacles,
                       const Facets<dim>       &facets,
                       const FaceNodes<dim>    &face_nodes,
                       const ContactNodes<dim> &nodes,
                       const SoilAtPlaces<dim> &soil,
                       const BedSlip<dim>      &slip)
      : obstacles_(obstacles)
      , facets_(facets)
      , face_nodes_(face_nodes)
      , nodes_(nodes)
      , soil_(soil)
      , slip_(slip)
    {}

    /// Delete all constraints. Call after each change of the mesh or its
    /// partition, after Facets::prepare().
    void
    prepare();

    /// Begin a step, without soil at any place.
    void
    begin_step();

    /// Compute the constraints of Facets::owned() from ContactNodes and
    /// SoilAtPlaces. If @p has_memory, a running mean of the normal impulse
    /// limits friction, otherwise the current impulse. Throws ExcPoint if soil
    /// is at a facet where cells of different size meet.
    void
    find(const State<dim> &state, bool has_memory);

    /// Compute the constraint of entry @p i of FaceNodes, whose node carries
    /// soil. @p has_memory: see find().
    void
    find_at_node(const State<dim> &state, unsigned int i, bool has_memory);

    /// Return the constraints of the step, one per facet of Facets::owned()
    /// and one per entry of FaceNodes.
    const std::vector<ContactConstraint<dim>> &
    all() const
    {
      return constraints_;
    }

    const ContactConstraint<dim> &
    operator[](const unsigned int place) const
    {
      return constraints_[place];
    }

    /// Number of the place of entry @p i of FaceNodes.
    unsigned int
    place_of_node(const unsigned int i) const
    {
      return facets_.owned().size() + i;
    }

    /// Indices in Facets::owned() of the facets with soil at their nodes.
    const std::vector<unsigned int> &
    loaded() const
    {
      return loaded_;
    }

    /// Mean velocity of the soil at a facet, m/s.
    dealii::Tensor<1, dim>
    velocity(unsigned int facet) const
    {
      return velocity(facets_.owned()[facet], constraints_[facet]);
    }

    /// Entries of FaceNodes with soil.
    const std::vector<unsigned int> &
    loaded_nodes() const
    {
      return loaded_nodes_;
    }

    /// Surface of a place.
    const Bed<dim> &
    bed(const unsigned int place) const
    {
      const auto &facets = facets_.owned();
      return place < facets.size() ? obstacles_[facets[place].obstacle].bed()
                                   : face_nodes_.bed();
    }

    /// Limit of friction of soil at rest at a place.
    CoulombLimit
    limit(unsigned int place) const;

    /// Return the length of the tangential impulse, N s, at most @p trial.
    /// @param place number of the place
    /// @param trial tangential impulse that would stop the soil, N s
    /// @param normal_impulse impulse along the normal, N s
    /// @param dt time step, s
    double
    friction_impulse(unsigned int place,
                     double       trial,
                     double       normal_impulse,
                     double       dt) const;

    /// Clearance between the soil at the node @p inside and the obstacle, m.
    double
    gap_inside(const Grid<dim>                        &grid,
               const typename Facets<dim>::NodeInside &inside) const
    {
      return soil_.gap(inside.node, inside.obstacle, grid.finest_size());
    }

  private:
    bool
    find_shares(const ContactFacet<dim> &facet,
                ContactConstraint<dim>  &constraint) const;
    void
    require_uniform(const ContactFacet<dim> &facet) const;
    void
    find_masses(const ContactFacet<dim> &facet,
                ContactConstraint<dim>  &constraint) const;
    double
    averaging_weight(const State<dim>             &state,
                     const ContactFacet<dim>      &facet,
                     const ContactConstraint<dim> &constraint) const;
    dealii::Tensor<1, dim>
    velocity(const ContactFacet<dim>      &facet,
             const ContactConstraint<dim> &constraint) const;

    const Obstacles<dim>               &obstacles_;
    const Facets<dim>                  &facets_;
    const FaceNodes<dim>               &face_nodes_;
    const ContactNodes<dim>            &nodes_;
    const SoilAtPlaces<dim>            &soil_;
    const BedSlip<dim>                 &slip_; ///< by place; empty: not kept
    std::vector<ContactConstraint<dim>> constraints_;
    std::vector<unsigned int>           loaded_, loaded_nodes_;
  };
} // namespace talus

#endif
