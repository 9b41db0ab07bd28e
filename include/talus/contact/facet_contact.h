// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_contact_h
#define talus_contact_facet_contact_h

#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/reaction.h>
#include <talus/contact/contact_nodes.h>
#include <talus/contact/facet_constraints.h>
#include <talus/contact/facet_impulses.h>
#include <talus/contact/facets.h>
#include <talus/interaction/nodal_interaction.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// One-sided contact with friction between soil and obstacles whose surfaces
  /// lie anywhere in the mesh.
  ///
  /// Each facet is a constraint on the mean velocity of the soil at its contact
  /// point: it must not enter the obstacle. The impulses of all facets are found
  /// by Jacobi's iteration with projection, one sweep per step, which starts
  /// from the impulses of the step before: where soil rests or slides these are
  /// nearly right. A facet is closed only while the boxes of the points come
  /// nearer than a twentieth of a cell. doc/method.md, section "Obstacles".
  template <int dim>
  class FacetContact : public NodalInteraction<dim>
  {
  public:
    /// Walls among @p boundaries hold nodes that touch obstacles.
    FacetContact(Obstacles<dim> &obstacles, Boundaries<dim> &boundaries);

    const Obstacles<dim> &
    obstacles() const
    {
      return obstacles_;
    }

    void
    open_accounts(Accounts<dim> &accounts) override
    {
      boundaries_.open_accounts(accounts);
    }

    /// Find facets and nodes. Facets that were there before keep their impulses.
    /// Collective.
    void
    prepare(const Grid<dim> &grid) override;

    /// Advance moving obstacles to the end of the time step.
    void
    begin_step(State<dim> &state) override;

    /// Solve for the impulses of the facets and change the velocities of the
    /// nodes by them. Collective.
    void
    correct_velocities(State<dim> &state) override;

    /// Sum the reactions of the step over the ranks.
    void
    record(State<dim> &state) override;

    /// Forces on the obstacles, one per obstacle; identical on all ranks.
    const std::vector<Reaction<dim>> &
    reactions() const
    {
      return reactions_;
    }

    /// By node, whether soil there feels an obstacle; empty without obstacles.
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

    /// Those of the last step, of facets().owned().
    const std::vector<FacetImpulse<dim>> &
    impulses() const
    {
      return impulses_.all();
    }

    /// In which the facets passed their impulses, s; 0 before the first step.
    double
    previous_time_step() const
    {
      return previous_time_step_;
    }

    /// Find the constraints of facets().owned() for soil whose masses and
    /// volumes at the nodes are known. Collective.
    void
    find_constraints(const State<dim> &state);

    /// As find_constraints() or the last step found them; none since
    /// prepare().
    const FacetConstraints<dim> &
    constraints() const
    {
      return constraints_;
    }

    /// For soil at rest: what facets().owned() pass to it, as impulses of one
    /// second. The first step takes its share of them.
    void
    set_forces(const std::vector<FacetImpulse<dim>> &forces);

    /// The impulses, to be kept, and back to them.
    std::vector<double>
    save() const
    {
      return impulses_.rows();
    }

    void
    restore(const std::vector<double> &saved)
    {
      impulses_.restore({});
      impulses_.take(saved);
    }

    void
    list_state(StateList &list) override;

  private:
    void
    take_restored(const State<dim> &state);
    void
    warm_start(const State<dim> &state);
    void
    sweep(const State<dim> &state);
    void
    add_impulse(unsigned int facet, const dealii::Tensor<1, dim> &impulse);
    void
    hold_nodes_inside(State<dim> &state);
    void
    record_facets(const State<dim>               &state,
                  std::vector<StepReaction<dim>> &steps) const;

    /// At a node that touches no facet.
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
    FacetImpulses<dim>         impulses_{facets_};
    std::vector<Reaction<dim>> reactions_;
    bool                       has_begun_          = false;
    double                     previous_time_step_ = 0; ///< s

    // Of one step
    ContactNodes<dim>          nodes_{facets_};
    FacetConstraints<dim>      constraints_{obstacles_, facets_, nodes_};
    std::vector<ImpulseInside> impulses_inside_;
  };
} // namespace talus

#endif
