// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_contact_h
#define talus_contact_facet_contact_h

#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/reaction.h>
#include <talus/contact/facets.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// What a facet passes to the soil in a step.
  template <int dim>
  struct FacetImpulse
  {
    double                 normal = 0; ///< along the facet's normal, N s
    dealii::Tensor<1, dim> tangential; ///< along the facet, N s
    double                 effective_mass = 0; ///< that the facet sees, kg
    double mean_normal = 0; ///< of the last steps, which limits friction, N s

    bool
    acts() const
    {
      return normal > 0 || tangential.norm_square() > 0;
    }
  };



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
  class FacetContact
  {
  public:
    /// A facet with the soil as it is: shares of its nodes in its velocity, and so on.
    struct Constraint
    {
      std::array<double, ContactFacet<dim>::n_nodes> share;
      bool   is_loaded   = false; ///< whether there is soil at its nodes
      double normal_mass = 0;     ///< kg; 0 where walls hold all nodes
      double mass        = 0;     ///< kg
      double gap         = 0;     ///< m
      double area        = 0;     ///< in contact, m^(dim-1)
      /// Share of this step's normal impulse in the mean that limits friction.
      double share_in_mean = 1;
    };

    explicit FacetContact(Obstacles<dim> &obstacles);

    const Obstacles<dim> &
    obstacles() const
    {
      return obstacles_;
    }

    /// Find facets and nodes; to be called after each change of the mesh or its
    /// partition. Facets that were there before keep their impulses.
    /// Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Let obstacles move on by the time step, before anybody asks where they
    /// are in it.
    void
    move_obstacles(const State<dim> &state);

    /// Change the velocities of the nodes after the momentum update, and before
    /// @p boundaries act, as obstacles ask. Collective.
    void
    apply(State<dim> &state, Boundaries<dim> &boundaries);

    /// Add up what the step did, when the velocities of all nodes, ghosts too,
    /// are final. Collective.
    void
    book(State<dim> &state, Boundaries<dim> &boundaries);

    /// Of the obstacles; all ranks have the same.
    const std::vector<Reaction<dim>> &
    reactions() const
    {
      return reactions_;
    }

    /// A row of the output was written.
    void
    start_interval();

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
      return impulses_;
    }

    /// In which the facets passed their impulses, s; 0 before the first step.
    double
    duration_of_impulses() const
    {
      return previous_time_step_;
    }

    /// Find the constraints of facets().owned() for soil whose masses and
    /// volumes at the nodes are known. Collective.
    void
    find_constraints(const State<dim> &state);

    /// As find_constraints() or the last step found them; none since
    /// prepare().
    const std::vector<Constraint> &
    constraints() const
    {
      return constraints_;
    }

    /// Room between such a node's soil and the obstacle, m; after
    /// find_constraints().
    double
    gap_inside(const Grid<dim>                        &grid,
               const typename Facets<dim>::NodeInside &inside) const;

    /// Largest impulse along the facet in a step of @p dt, N s, for this
    /// impulse along the normal.
    double
    friction_limit(const ContactFacet<dim> &facet,
                   const Constraint        &constraint,
                   double                   normal_impulse,
                   double                   dt) const;

    /// For soil at rest: what facets().owned() pass to it, as impulses of one
    /// second. The first step takes its share of them.
    void
    set_forces(const std::vector<FacetImpulse<dim>> &forces);

    /// The impulses, to be kept, and back to them.
    std::vector<double>
    save() const
    {
      return restored_.empty() ? rows_of_impulses() : restored_;
    }

    void
    restore(const std::vector<double> &saved)
    {
      restored_.clear();
      take_impulses(saved);
    }

    void
    list_state(StateList &list);

  private:
    // Impulses of facets as rows of numbers: key of the cell (two), obstacle,
    // and those of FacetImpulse.
    static constexpr unsigned int n_columns = 6 + dim;
    std::vector<double>
    rows_of_impulses() const;
    void
    take_impulses(const std::vector<double> &rows);
    void
    take_restored(const State<dim> &state);
    void
    hold_walls(State<dim> &state, Boundaries<dim> &boundaries);
    std::vector<typename NodalGaps<dim>::Surface>
    surfaces() const;
    void
    load_nodes(const State<dim> &state);
    Constraint
    constraint_of(const State<dim>        &state,
                  const ContactFacet<dim> &facet) const;
    double
    share_in_mean(const State<dim>        &state,
                  const ContactFacet<dim> &facet,
                  const Constraint        &constraint) const;
    void
    warm_start(const State<dim> &state);
    void
    sweep(const State<dim> &state);
    dealii::Tensor<1, dim>
    velocity_at(const ContactFacet<dim> &facet,
                const Constraint        &constraint) const;
    void
    add_impulse(const ContactFacet<dim>      &facet,
                const Constraint             &constraint,
                const dealii::Tensor<1, dim> &impulse);
    void
    update_velocities(const State<dim> &state);
    void
    hold_nodes_inside(State<dim> &state);
    void
    book_walls(State<dim> &state, Boundaries<dim> &boundaries) const;
    void
    book_facets(const State<dim>               &state,
                std::vector<StepReaction<dim>> &steps) const;

    /// At a node that touches no facet.
    struct ImpulseInside
    {
      unsigned int           node;
      unsigned int           obstacle;
      dealii::Point<dim>     place;
      dealii::Tensor<1, dim> impulse; ///< on the soil, N s
    };

    // By node: degree of filling [-], number of facets over mass [1/kg], and
    // velocity [m/s].
    enum Record
    {
      fill,
      splitting,
      velocity,
      width = velocity + dim
    };

    Obstacles<dim>                &obstacles_;
    Facets<dim>                    facets_;
    std::vector<FacetImpulse<dim>> impulses_;
    std::vector<Reaction<dim>>     reactions_;
    bool                           has_begun_          = false;
    double                         previous_time_step_ = 0; ///< s
    std::vector<double> restored_; ///< rows of a checkpoint, for the next step

    // Of one step
    std::vector<Constraint>    constraints_;
    std::vector<unsigned int>  loaded_; ///< facets with soil at their nodes
    std::vector<unsigned int>  active_nodes_; ///< owned ones with soil
    std::vector<ImpulseInside> impulses_inside_;
    std::vector<double>        records_;        ///< see Record
    NodalGaps<dim>             gaps_;           ///< the obstacles' surfaces
    std::vector<double>        nodal_impulses_; ///< of a sweep, N s
    std::vector<double>        total_impulses_; ///< of the step, N s
    std::vector<unsigned char> held_;           ///< components, by node
    NodalExchange<dim>         exchange_of_records_, exchange_of_impulses_;
  };
} // namespace talus

#endif
