// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_contact_h
#define talus_contact_contact_h

#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/reaction.h>
#include <talus/contact/body_coupling.h>
#include <talus/contact/contact_constraints.h>
#include <talus/contact/contact_impulses.h>
#include <talus/contact/contact_nodes.h>
#include <talus/contact/face_nodes.h>
#include <talus/contact/facets.h>
#include <talus/interaction/nodal_interaction.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// One-sided contact with friction between soil and surfaces: seabed faces of
  /// the mesh, and obstacles, whose surfaces lie anywhere in the mesh.
  ///
  /// Each place of a surface is a constraint: the mean velocity of the soil at
  /// the place must not lead into the surface. A place is a facet of an
  /// obstacle, with the nodes of a cell, or a node of a seabed face. Jacobi's
  /// iteration with projection computes the impulses of all facets, with one
  /// sweep per step. The iteration starts from the impulses of the previous
  /// step, which are nearly right where soil rests or slides. The impulse of a
  /// node of a face is exact at once. doc/method.md, section "Contact".
  template <int dim>
  class Contact : public NodalInteraction<dim>
  {
  public:
    /// @p boundaries tell which faces are a seabed and hold the nodes at walls.
    Contact(Obstacles<dim> &obstacles, Boundaries<dim> &boundaries);

    const Obstacles<dim> &
    obstacles() const
    {
      return obstacles_;
    }

    void
    open_accounts(Accounts<dim> &accounts) override
    {
      boundaries_.open_accounts(accounts);
      bodies_.open_accounts(accounts);
    }

    /// Cut the cells by the obstacles: facets and nodes in contact. A place
    /// that existed before keeps the impulse. Collective.
    void
    prepare(const Grid<dim> &grid) override;

    /// Advance obstacles with a prescribed velocity to the end of the time
    /// step, and examine the soil at all surfaces.
    void
    begin_step(State<dim> &state) override;

    /// Compute the impulses of all places and apply the impulses to the
    /// velocities of the nodes. Collective.
    void
    correct_velocities(State<dim> &state) override;

    /// Sum the reactions of the step over the ranks, and move obstacles with a
    /// mass to the end of the step.
    void
    record(State<dim> &state) override;

    /// Forces on the obstacles, one per obstacle; identical on all ranks.
    const std::vector<Reaction<dim>> &
    reactions() const
    {
      return reactions_;
    }

    /// Whether an obstacle acts on soil at a node, 1 or 0, by node; empty
    /// without obstacles.
    const std::vector<unsigned char> &
    feels_obstacle() const
    {
      return facets_.contact_nodes();
    }

    const Facets<dim> &
    facets() const
    {
      return facets_;
    }

    /// Owned nodes of seabed faces.
    const FaceNodes<dim> &
    face_nodes() const
    {
      return face_nodes_;
    }

    /// Set a rule that leaves a share of the maximum shear stress at nodes of
    /// seabed faces, see FaceNodes::set_share_left().
    void
    set_share_left(const typename FaceNodes<dim>::ShareLeft &share_left)
    {
      face_nodes_.set_share_left(share_left);
    }

    /// Return the impulses of the last step, one per facet of facets().owned()
    /// and one per entry of face_nodes().
    const std::vector<ContactImpulse<dim>> &
    impulses() const
    {
      return impulses_.all();
    }

    /// Length of the step in which impulses() acted, s; 0 before the first
    /// step.
    double
    previous_time_step() const
    {
      return previous_time_step_;
    }

    /// Whether slip() is kept: a surface softens by slip, or the trigger has a
    /// region.
    bool
    keeps_slip() const
    {
      return boundaries_.seabed().changes_by_slip() ||
             obstacles_.change_by_slip() || slip_.has_region();
    }

    /// Slip of soil over the places, as in impulses(); without places unless
    /// keeps_slip().
    BedSlip<dim> &
    slip()
    {
      return slip_;
    }

    const BedSlip<dim> &
    slip() const
    {
      return slip_;
    }

    /// Examine the soil at the surfaces, see soil(). Collective.
    void
    find_soil(const State<dim> &state)
    {
      take_restored(state);
      soil_.find(state);
    }

    /// Soil at the seabeds and at facets().owned() in this step, after
    /// begin_step() or find_soil().
    const SoilAtPlaces<dim> &
    soil() const
    {
      return soil_;
    }

    /// Compute the constraints of all places from soil() and the masses at the
    /// nodes. Collective.
    void
    find_constraints(const State<dim> &state);

    /// Return the constraints of the last find_constraints() or the last step;
    /// empty after prepare().
    const ContactConstraints<dim> &
    constraints() const
    {
      return constraints_;
    }

    /// Set the impulses of facets().owned() from the forces of soil at rest,
    /// one impulse per facet, each for a duration of 1 s. The first step scales
    /// the impulses to the time step.
    void
    set_forces(const std::vector<ContactImpulse<dim>> &forces);

    /// Return the impulses as rows, to undo later steps by restore().
    std::vector<double>
    save() const
    {
      return impulses_.rows();
    }

    void
    restore(const std::vector<double> &saved)
    {
      impulses_.restore(saved);
      impulses_.update(impulses_.places());
    }

    /// Area that soil has slipped over, and the largest slip, where a surface
    /// softens.
    void
    list_quantities(const State<dim> &state, Quantities &list) const override;

    void
    list_state(StateList &list) override;

  private:
    std::vector<PlaceKey>
    keys() const;
    std::vector<BedPlace<dim>>
    places() const;
    void
    update_places();
    void
    add_slip(const State<dim> &state);
    void
    find_impulses_of_facets(State<dim> &state);
    void
    find_impulses_of_nodes(State<dim> &state);
    void
    project_at_node(State<dim> &state, unsigned int i, double longer);
    void
    take_restored(const State<dim> &state);
    void
    warm_start(const State<dim> &state);
    void
    sweep(const State<dim> &state, bool is_read_at_ghosts);
    void
    add_impulse(unsigned int facet, const dealii::Tensor<1, dim> &impulse);
    void
    hold_nodes_inside(State<dim> &state);
    std::vector<StepReaction<dim>>
    reactions_of_obstacles(const State<dim> &state) const;
    void
    record_nodes(State<dim> &state);

    /// Impulse on a node inside an obstacle that touches no facet.
    struct ImpulseInside
    {
      unsigned int           node;
      unsigned int           obstacle;
      dealii::Point<dim>     place;
      dealii::Tensor<1, dim> impulse; ///< on the soil, N s
    };

    Obstacles<dim>            &obstacles_;
    Boundaries<dim>           &boundaries_;
    Facets<dim>                facets_;
    FaceNodes<dim>             face_nodes_{boundaries_};
    ContactImpulses<dim>       impulses_;
    BedSlip<dim>               slip_; ///< by place
    std::vector<Reaction<dim>> reactions_;
    bool                       has_begun_          = false;
    double                     previous_time_step_ = 0; ///< s

    // Data of one step
    SoilAtPlaces<dim>       soil_{obstacles_, facets_};
    ContactNodes<dim>       nodes_{facets_};
    ContactConstraints<dim> constraints_{
      obstacles_, facets_, face_nodes_, nodes_, soil_, slip_};
    BodyCoupling<dim> bodies_{obstacles_, facets_, constraints_, impulses_};
    std::vector<ImpulseInside> impulses_inside_;
  };
} // namespace talus

#endif
