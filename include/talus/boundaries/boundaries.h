// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundaries_h
#define talus_boundaries_boundaries_h

#include <talus/boundaries/boundary_condition.h>
#include <talus/boundaries/boundary_reactions.h>
#include <talus/boundaries/seabed.h>
#include <talus/interaction/nodal_interaction.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Energy and impulses that the boundaries exchanged with the soil in one step.
  template <int dim>
  struct BoundaryWork
  {
    double friction = 0; ///< energy taken by friction on seabeds, J
    /// Energy taken by normal contact, walls and tractions, J; negative where
    /// these drive the soil.
    double                 contact = 0;
    dealii::Tensor<1, dim> seabed_impulse; ///< on the soil, N s
    dealii::Tensor<1, dim> wall_impulse;   ///< of walls and tractions, N s

    /// Add to the accounts that Boundaries::open_accounts() opened.
    void
    record(Accounts<dim> &accounts) const
    {
      accounts.energy("friction work") += friction;
      accounts.energy("contact work") += contact;
      accounts.impulse("seabed impulse") += seabed_impulse;
      accounts.impulse("wall impulse") += wall_impulse;
    }
  };



  /// Conditions on the faces of the mesh.
  ///
  /// A node on several faces: tractions are forces and come first, of all
  /// faces. `fixed` holds all components. Else a component that several faces
  /// with `velocity` prescribe is that of the face whose normal it is, or else
  /// of the first of them; rollers then hold their normals, since nothing may
  /// pass a wall. The seabed acts last, on what is so prescribed, but moves only
  /// the other components.
  ///
  /// A new condition is a class that derives from BoundaryCondition and a line
  /// in the list of source/boundaries/boundaries.cc.
  template <int dim>
  class Boundaries : public dealii::ParameterAcceptor,
                     public NodalInteraction<dim>
  {
  public:
    Boundaries();

    /// Parse the expressions with @p constants. Throws ExcUser if conditions and
    /// expressions contradict each other.
    void
    parse(const Constants &constants);

    void
    open_accounts(Accounts<dim> &accounts) override;

    /// Find the nodes of the seabed, and the places of nodes that expressions
    /// are needed at. Collective.
    void
    prepare(const Grid<dim> &grid) override;

    void
    add_forces(State<dim> &state) override
    {
      add_tractions(state.nodes,
                    state.grid,
                    state.time,
                    state.constants.mass_cutoff);
    }

    void
    correct_velocities(State<dim> &state) override
    {
      apply(state.nodes,
            state.grid,
            state.time,
            state.time_step,
            state.constants.mass_cutoff)
        .record(state.accounts);
    }

    /// Sum the reactions of the step over the ranks.
    void
    record(State<dim> &state) override
    {
      reactions_.finish_step(state.communicator());
    }

    /// Whether nothing is there: a point that crosses the face has left.
    bool
    is_free(const unsigned int face) const
    {
      return names_[face] == "free" || is_outflow(face);
    }

    /// Whether points that cross the face are taken out of the run and counted;
    /// at other free faces a point that leaves is an error.
    bool
    is_outflow(const unsigned int face) const
    {
      return names_[face] == "outflow";
    }

    /// Whether velocities or tractions of a face follow expressions.
    bool
    has_expressions() const
    {
      return std::any_of(names_.begin(), names_.end(), [](const auto &name) {
        return name == "velocity" || name == "traction";
      });
    }

    bool
    is_seabed(const unsigned int face) const
    {
      return names_[face] == "seabed";
    }

    bool
    has_seabed() const;

    /// To be called before prepare() if the seabed depends on the depth.
    void
    set_depth(const typename ShearStressCap<dim>::Depth &depth)
    {
      seabed_.set_depth(depth);
    }

    /// Let the seabed pass @p factor times its maximum shear stress [-].
    void
    scale_seabed_shear_stress(const double factor)
    {
      seabed_.friction().scale_shear_stress(factor);
    }

    /// From now on all that resists sliding on the seabed is @p factor times
    /// its parameter [-].
    void
    scale_seabed_strength(const double factor)
    {
      seabed_.friction().scale_strength(factor);
    }

    /// Axes whose two faces are periodic. Throws ExcUser if only one is.
    std::array<bool, dim>
    periodic_axes() const;

    /// Bit d is set if walls hold a node on these faces (see
    /// Grid::faces_of_node) along axis d, or drive it.
    unsigned char
    components_constrained_by_walls(unsigned char faces) const;

    const Seabed<dim> &
    seabed() const
    {
      return seabed_;
    }

    /// Bit d is set if a node on these faces may be held along axis d, by a
    /// wall or by the seabed.
    unsigned char
    constrained_components(unsigned char faces) const;

    /// Throws ExcPoint if an expression has no finite value at a node of its
    /// face at time @p t, s, whether there is soil or not.
    void
    check_values(const Grid<dim> &grid, double t);

    /// Add the tractions at time @p t, s, to the forces of the active nodes on
    /// the faces, before the momentum update. Nodes with less than
    /// @p mass_cutoff carry nothing and are left alone, here and in apply().
    void
    add_tractions(NodalFields<dim> &nodes,
                  const Grid<dim>  &grid,
                  double            t,
                  double            mass_cutoff);

    /// Give a node on @p faces the velocity that walls prescribe in a step from
    /// time @p t over @p dt, s, and record the impulse that this takes.
    void
    impose_walls(NodalFields<dim>  &nodes,
                 unsigned char      faces,
                 unsigned int       node,
                 double             t,
                 double             dt,
                 BoundaryWork<dim> &work);

    /// Record an impulse on the soil, N s, that walls took up at a node on @p faces,
    /// in components that they hold.
    void
    record_walls(const NodalFields<dim>       &nodes,
                 unsigned char                 faces,
                 unsigned int                  node,
                 const dealii::Tensor<1, dim> &impulse,
                 BoundaryWork<dim>            &work);

    void
    set_covered_area(const typename Seabed<dim>::CoveredArea &covered_area)
    {
      seabed_.set_covered_area(covered_area);
    }

    /// For a seabed with a gap: how far soil at a node is from a face, m, beyond
    /// what counts as contact.
    using Gap = std::function<double(unsigned int face, unsigned int node)>;
    void
    set_gap(const Gap &gap)
    {
      gap_ = gap;
    }

    /// Change the velocities of the active nodes on the faces as their
    /// conditions ask, after the momentum update of a step from time @p t over
    /// @p dt; velocities are those of the half step, t + dt/2. Returns what the
    /// boundaries did, the tractions added before included.
    BoundaryWork<dim>
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          double            t,
          double            dt,
          double            mass_cutoff);

    /// Places where a seabed at the bottom of the mesh acted in the last step, m,
    /// at the nodes of this rank, and the force of its friction on the soil, N.
    const std::vector<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>> &
    bed_friction() const
    {
      return bed_friction_;
    }

    /// Forces on each face that has a condition, if they are asked for.
    BoundaryReactions<dim> &
    reactions()
    {
      return reactions_;
    }

    const BoundaryReactions<dim> &
    reactions() const
    {
      return reactions_;
    }

    void
    list_state(StateList &list) override;

  private:
    void
    check_expression(unsigned int       face,
                     const std::string &condition,
                     const std::string &text) const;
    void
    check_expressions(unsigned int face) const;
    void
    make_conditions(const Constants &constants);
    const dealii::Point<dim> &
    place_of(unsigned int node) const;
    VelocityConstraints<dim>
    constraints_at(unsigned char faces, unsigned int node, double t);
    void
    add_wall_reactions(const VelocityConstraints<dim> &constraints,
                       const NodalFields<dim>         &nodes,
                       unsigned int                    node,
                       const dealii::Tensor<1, dim>   &impulse);
    void
    apply_to_node(NodalFields<dim>  &nodes,
                  const Grid<dim>   &grid,
                  unsigned int       node,
                  double             t,
                  double             dt,
                  BoundaryWork<dim> &work);

    // Parameters, by face
    std::array<std::string, 2 * dim> names_;
    std::array<std::string, 2 * dim> velocity_texts_;
    std::array<std::string, 2 * dim> traction_texts_;
    bool                             writes_forces_ = false;

    Seabed<dim> seabed_;
    /// In the order in which they act.
    std::vector<std::unique_ptr<BoundaryCondition<dim>>> conditions_;
    BoundaryReactions<dim> reactions_; ///< of these
    Gap                    gap_;
    std::vector<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>>
      bed_friction_;

    /// Places of the owned nodes, by node, m; empty where nothing needs them.
    std::vector<dealii::Point<dim>> places_;

    /// What a condition with a traction does to a node in this step.
    struct LoadedNode
    {
      unsigned int           node;
      unsigned int           condition;
      dealii::Tensor<1, dim> force; ///< N
    };
    std::vector<LoadedNode> loaded_;
  };
} // namespace talus

#endif
