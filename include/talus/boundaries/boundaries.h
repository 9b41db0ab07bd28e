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
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Energy and impulse exchanged between walls and soil in one step.
  template <int dim>
  struct BoundaryWork
  {
    /// Energy taken by walls and tractions, J; negative where the boundaries
    /// drive the soil.
    double                 contact = 0;
    dealii::Tensor<1, dim> wall_impulse; ///< on the soil, N s

    /// Add to the accounts opened by Boundaries::open_accounts().
    void
    record(Accounts<dim> &accounts) const
    {
      accounts.energy("contact work") += contact;
      accounts.impulse("wall impulse") += wall_impulse;
    }
  };



  /// Conditions on the faces of the mesh.
  ///
  /// Conditions act on a node of several faces in a fixed order. Tractions are
  /// forces and come first, on all faces. Velocities follow: if several faces
  /// with `velocity` prescribe a component, the face normal to the component
  /// decides, otherwise the first face. Rollers then hold their normal
  /// components, because nothing may pass a wall, and `fixed` holds all
  /// components. The contact with a seabed belongs to Contact, which
  /// changes only components that no wall prescribes.
  ///
  /// A new condition is a class derived from BoundaryCondition and a line in
  /// the list of source/boundaries/boundaries.cc.
  template <int dim>
  class Boundaries : public dealii::ParameterAcceptor,
                     public NodalInteraction<dim>
  {
  public:
    Boundaries();

    /// Parse the expressions with @p constants and the named @p surfaces, if
    /// there are any. Throws ExcUser if conditions and expressions contradict
    /// each other.
    void
    parse(const Constants          &constants,
          const SurfaceSource<dim> *surfaces = nullptr);

    void
    open_accounts(Accounts<dim> &accounts) override;

    /// Find the positions of the nodes if a condition or an output needs
    /// positions. Collective.
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

    /// Apply the walls to the velocities of the active nodes on the faces.
    /// Velocities belong to the half step, t + dt/2. Records energies and
    /// impulses of the boundaries, including the tractions of add_tractions().
    void
    correct_velocities(State<dim> &state) override;

    /// Sum the reactions of the step over the ranks.
    void
    record(State<dim> &state) override
    {
      reactions_.finish_step(state.communicator());
    }

    /// Whether @p face is open: a point that crosses the face leaves the mesh.
    bool
    is_free(const unsigned int face) const
    {
      return names_[face] == "free" || is_outflow(face);
    }

    /// Whether points that cross the face are removed from the run and counted;
    /// a point that leaves through any other free face is an error.
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

    /// Whether the velocity along the normal of @p face follows an expression.
    bool
    drives_normal(unsigned int face) const;

    /// Velocity along the axis of the normal of @p face at @p x, m, time @p t,
    /// s, in m/s; only if drives_normal().
    double
    normal_velocity(unsigned int face, const dealii::Point<dim> &x, double t);

    bool
    is_seabed(const unsigned int face) const
    {
      return names_[face] == "seabed";
    }

    /// Faces with a seabed, bit f for face f of the mesh.
    unsigned char
    seabed_faces() const;

    /// Faces that are `fixed`, bit f for face f of the mesh.
    unsigned char
    fixed_faces() const;

    bool
    has_seabed() const
    {
      return seabed_faces() != 0;
    }

    /// Whether the two faces of an axis are periodic, by axis. Throws ExcUser
    /// if only one face is periodic.
    std::array<bool, dim>
    periodic_axes() const;

    /// Components held or driven by walls at a node on @p faces (see
    /// Grid::faces_of_node): bit d stands for axis d.
    unsigned char
    components_constrained_by_walls(unsigned char faces) const;

    const Seabed<dim> &
    seabed() const
    {
      return seabed_;
    }

    Seabed<dim> &
    seabed()
    {
      return seabed_;
    }

    /// Components that a wall or the seabed may hold at a node on @p faces: bit
    /// d stands for axis d.
    unsigned char
    constrained_components(unsigned char faces) const;

    /// Throw ExcPoint if an expression has no finite value at a node of the
    /// face at time @p t, s, even at nodes without soil.
    void
    check_values(const Grid<dim> &grid, double t);

    /// Add the tractions at time @p t, s, to the forces of the active nodes on
    /// the faces, before the momentum update. Nodes with a mass of at most
    /// @p mass_cutoff, kg, are left out, also in correct_velocities().
    void
    add_tractions(NodalFields<dim> &nodes,
                  const Grid<dim>  &grid,
                  double            t,
                  double            mass_cutoff);

    /// Position of an owned node on a face of the mesh, m; undefined if nothing
    /// needs positions, as a seabed does.
    const dealii::Point<dim> &
    place_of(unsigned int node) const;

    /// Give a node on a face of the mesh the velocity prescribed by walls, and
    /// add energy and impulse to @p work.
    void
    impose_walls(State<dim> &state, unsigned int node, BoundaryWork<dim> &work);

    /// Stop the nodes on the held faces (RunConstants) in a pass of the filter
    /// of velocities. @p is_recorded: add the impulses to the accounts.
    void
    hold_nodes(State<dim> &state, bool is_recorded);

    /// Record the impulse @p impulse, N s, of walls on the soil at a node, in
    /// components held by the walls.
    void
    record_walls(const State<dim>             &state,
                 unsigned int                  node,
                 const dealii::Tensor<1, dim> &impulse,
                 BoundaryWork<dim>            &work);

    /// Forces on each face with a condition, if the parameter `Write forces` is
    /// set.
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
    VelocityConstraints<dim>
    constraints_at(unsigned char faces, unsigned int node, double t);
    void
    record_walls(const VelocityConstraints<dim> &constraints,
                 const NodalFields<dim>         &nodes,
                 unsigned int                    node,
                 const dealii::Tensor<1, dim>   &impulse,
                 BoundaryWork<dim>              &work);

    // Parameters, by face
    std::array<std::string, 2 * dim> names_;
    std::array<std::string, 2 * dim> velocity_texts_;
    std::array<std::string, 2 * dim> traction_texts_;
    bool                             writes_forces_ = false;

    Seabed<dim> seabed_;
    /// Conditions in the order in which they act.
    std::vector<std::unique_ptr<BoundaryCondition<dim>>> conditions_;
    BoundaryReactions<dim>                               reactions_;

    /// Positions of the owned nodes, by node, m; empty unless needed.
    std::vector<dealii::Point<dim>> places_;

    /// Force of a condition with a traction on a node in this step.
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
