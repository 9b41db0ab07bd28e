// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/wall_conditions.h>
#include <talus/grid/node_places.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using ConditionPtr = std::unique_ptr<BoundaryCondition<dim>>;



    template <typename Condition, int dim>
    ConditionPtr<dim>
    make(const FaceDescription<dim> &description)
    {
      return std::make_unique<Condition>(description);
    }



    template <int dim>
    struct ConditionKind
    {
      std::string name; ///< in the parameter file
      /// Null if Boundaries does nothing to the nodes of such faces.
      ConditionPtr<dim> (*make)(const FaceDescription<dim> &);
    };



    /// All kinds of conditions, in the order of action at a node: later
    /// conditions override earlier ones. Velocities come first. Rollers follow,
    /// since nothing may pass a wall, whatever another face prescribes. `fixed`
    /// then holds all components (doc/method.md, section 5).
    template <int dim>
    const std::vector<ConditionKind<dim>> &
    condition_kinds()
    {
      static const std::vector<ConditionKind<dim>> list = {
        {"free", nullptr},
        {"outflow", nullptr},
        {"periodic", nullptr},
        {"traction", make<TractionCondition<dim>, dim>},
        {"velocity", make<VelocityCondition<dim>, dim>},
        {"roller", make<RollerCondition<dim>, dim>},
        {"fixed", make<FixedCondition<dim>, dim>},
        {"seabed", nullptr}};
      return list;
    }



    /// Names of all kinds as the pattern of a selection.
    template <int dim>
    std::string
    all_condition_names()
    {
      std::string result;
      for (const ConditionKind<dim> &kind : condition_kinds<dim>())
        result += (result.empty() ? "" : "|") + kind.name;
      return result;
    }
  } // namespace



  template <int dim>
  unsigned char
  Boundaries<dim>::seabed_faces() const
  {
    unsigned char result = 0;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      result |= is_seabed(face) << face;
    return result;
  }



  template <int dim>
  unsigned char
  Boundaries<dim>::fixed_faces() const
  {
    unsigned char result = 0;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      result |= (names_[face] == "fixed") << face;
    return result;
  }



  // Positions cost a loop over all owned cells, and memory for each node.
  template <int dim>
  void
  Boundaries<dim>::prepare(const Grid<dim> &grid)
  {
    places_.clear();
    if (reactions_.is_enabled() || has_seabed() ||
        std::any_of(conditions_.begin(),
                    conditions_.end(),
                    [](const auto &condition) {
                      return condition->depends_on_place();
                    }))
      places_ = places_of_owned_nodes(grid);
  }



  template <int dim>
  void
  Boundaries<dim>::open_accounts(Accounts<dim> &accounts)
  {
    accounts.open_energy("friction work");
    accounts.open_energy("contact work");
    accounts.open_impulse("seabed impulse");
    accounts.open_impulse("wall impulse");
  }



  // The condition alone decides, whatever the soil does. The static stages have
  // no unknowns for these components.
  template <int dim>
  unsigned char
  Boundaries<dim>::components_constrained_by_walls(
    const unsigned char faces) const
  {
    unsigned char result = 0;
    for (const auto &condition : conditions_)
      if (condition->acts_on(faces))
        for (unsigned int d = 0; d < dim; ++d)
          if (condition->constrains(d))
            result |= 1u << d;
    return result;
  }



  // The seabed may hold all components or none, as the soil pushes: all
  // components count as held.
  template <int dim>
  unsigned char
  Boundaries<dim>::constrained_components(const unsigned char faces) const
  {
    return (faces & seabed_faces()) ? (1u << dim) - 1
                                    : components_constrained_by_walls(faces);
  }



  template <int dim>
  bool
  Boundaries<dim>::drives_normal(const unsigned int face) const
  {
    return names_[face] == "velocity" &&
           (components_constrained_by_walls(1u << face) >> face / 2) & 1;
  }



  template <int dim>
  double
  Boundaries<dim>::normal_velocity(const unsigned int face,
                                   const Point<dim>  &x,
                                   const double       t)
  {
    VelocityConstraints<dim> constraints;
    for (unsigned int c = 0; c < conditions_.size(); ++c)
      if (conditions_[c]->face() == face)
        conditions_[c]->constrain(x, t, c, constraints);
    const auto along_normal =
      std::find_if(constraints.begin(),
                   constraints.end(),
                   [face](const VelocityConstraint<dim> &constraint) {
                     return constraint.normal ==
                            Point<dim>::unit_vector(face / 2);
                   });
    AssertThrow(along_normal != constraints.end(), ExcInternalError());
    return along_normal->velocity;
  }



  template <int dim>
  const Point<dim> &
  Boundaries<dim>::place_of(const unsigned int node) const
  {
    static const Point<dim> unknown; // not used
    return places_.empty() ? unknown : places_[node];
  }



  /// Constraints of walls on a node on @p faces at time @p t, s.
  template <int dim>
  VelocityConstraints<dim>
  Boundaries<dim>::constraints_at(const unsigned char faces,
                                  const unsigned int  node,
                                  const double        t)
  {
    VelocityConstraints<dim> constraints;
    for (unsigned int c = 0; c < conditions_.size(); ++c)
      if (conditions_[c]->acts_on(faces))
        conditions_[c]->constrain(place_of(node), t, c, constraints);
    return constraints;
  }



  /// Record the impulse of walls on a node, for each constraint the part along
  /// its normal.
  template <int dim>
  void
  Boundaries<dim>::record_walls(const VelocityConstraints<dim> &constraints,
                                const NodalFields<dim>         &nodes,
                                const unsigned int              node,
                                const Tensor<1, dim>           &impulse,
                                BoundaryWork<dim>              &work)
  {
    const Tensor<1, dim> v = nodes.mean_velocity(node);
    work.contact -= impulse * v;
    work.wall_impulse += impulse;
    if (reactions_.is_enabled())
      for (const VelocityConstraint<dim> &constraint : constraints)
        reactions_.in_step(conditions_[constraint.owner]->face())
          .add_contact(place_of(node),
                       (impulse * constraint.normal) * constraint.normal,
                       Tensor<1, dim>(),
                       v);
  }



  // The owner of a constraint does not depend on the time.
  template <int dim>
  void
  Boundaries<dim>::record_walls(const State<dim>     &state,
                                const unsigned int    node,
                                const Tensor<1, dim> &impulse,
                                BoundaryWork<dim>    &work)
  {
    record_walls(constraints_at(state.grid.faces_of_node(node), node, 0.),
                 state.nodes,
                 node,
                 impulse,
                 work);
  }



  template <int dim>
  void
  Boundaries<dim>::impose_walls(State<dim>        &state,
                                const unsigned int node,
                                BoundaryWork<dim> &work)
  {
    NodalFields<dim>   &nodes = state.nodes;
    const unsigned char faces = state.grid.faces_of_node(node);
    const auto          constraints =
      constraints_at(faces, node, state.time + 0.5 * state.time_step);
    if (constraints.begin() == constraints.end())
      return;
    Tensor<1, dim> impulse = constraints.impose(nodes, node);
    if (faces & state.constants.held_faces)
      {
        // The mean of sheared soil at the node is no velocity of the soil at
        // the wall: the wall bears the force, and the mean stays.
        impulse -= nodes.mass(node) * nodes.increment(node);
        nodes.set_motion(node, nodes.velocity(node), Tensor<1, dim>());
      }
    record_walls(constraints, nodes, node, impulse, work);
  }



  template <int dim>
  void
  Boundaries<dim>::hold_nodes(State<dim> &state, const bool is_recorded)
  {
    BoundaryWork<dim> work;
    for (const unsigned int node : state.nodes.active_boundary_nodes())
      if (state.grid.faces_of_node(node) & state.constants.held_faces)
        {
          const auto impulse = state.nodes.set_velocity(node, {});
          state.nodes.set_motion(node, {}, {});
          if (is_recorded)
            record_walls(state, node, impulse, work);
        }
    work.record(state.accounts);
  }



  template <int dim>
  void
  Boundaries<dim>::check_values(const Grid<dim> &grid, const double t)
  {
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (const unsigned char faces = grid.faces_of_node(node))
        {
          constraints_at(faces, node, t);
          for (const auto &condition : conditions_)
            if (condition->acts_on(faces))
              condition->traction(place_of(node), t);
        }
  }



  // A traction is a force and enters the momentum update: a wall that holds the
  // node then simply bears the traction. The work is known only when all
  // conditions have acted: correct_velocities() computes the work from the list
  // of loaded nodes.
  template <int dim>
  void
  Boundaries<dim>::add_tractions(NodalFields<dim> &nodes,
                                 const Grid<dim>  &grid,
                                 const double      t,
                                 const double      mass_cutoff)
  {
    loaded_.clear();
    if (std::none_of(conditions_.begin(),
                     conditions_.end(),
                     [](const auto &condition) {
                       return condition->has_traction();
                     }))
      return;
    for (const unsigned int node : nodes.active_boundary_nodes())
      if (nodes.mass(node) > mass_cutoff)
        for (unsigned int c = 0; c < conditions_.size(); ++c)
          if (BoundaryCondition<dim> &condition = *conditions_[c];
              condition.has_traction() &&
              condition.acts_on(grid.faces_of_node(node)))
            {
              const FaceShare share = grid.face_share(condition.face(), node);
              const double f = std::min(1., nodes.volume(node) / share.volume);
              const Tensor<1, dim> force =
                f * share.area * condition.traction(place_of(node), t);
              nodes.add_force(node, force);
              loaded_.push_back({node, c, force});
            }
  }



  // With the lumped mass no node depends on the neighbours: the order of the
  // nodes matters only for round-off in the sums.
  template <int dim>
  void
  Boundaries<dim>::correct_velocities(State<dim> &state)
  {
    const NodalFields<dim> &nodes = state.nodes;
    BoundaryWork<dim>       work;
    for (const unsigned int node : nodes.active_boundary_nodes())
      if (nodes.mass(node) > state.constants.mass_cutoff)
        impose_walls(state, node, work);
    for (const LoadedNode &loaded : loaded_)
      {
        const Tensor<1, dim> impulse = state.time_step * loaded.force;
        const Tensor<1, dim> v       = nodes.mean_velocity(loaded.node);
        work.contact -= impulse * v;
        work.wall_impulse += impulse;
        if (reactions_.is_enabled())
          reactions_.in_step(conditions_[loaded.condition]->face())
            .add_contact(place_of(loaded.node), impulse, Tensor<1, dim>(), v);
      }
    work.record(state.accounts);
  }



  // Expressions are separate parameters, not part of the text of a condition:
  // errors name the parameter, and conditions can be a selection.
  template <int dim>
  Boundaries<dim>::Boundaries()
    : ParameterAcceptor("/Boundaries")
  {
    // A face not named in the file is free: a point that crosses the face ends
    // the run, so that a forgotten wall is noticed.
    names_.fill("free");
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        add_parameter(
          face_names[face],
          names_[face],
          "Condition on this face of the mesh: 'free' (a point that crosses "
          "the face ends the run with an error), 'outflow' (a point that "
          "crosses the face is removed from the run and counted), 'roller' (no "
          "motion along the normal), 'fixed' (no motion), 'seabed' (contact "
          "with friction, see section Seabed), 'periodic' (soil that leaves "
          "here enters through the opposite face; both faces must be "
          "periodic), 'velocity' or 'traction' (by the expressions of this "
          "face). 3-D adds the faces Back (lower z) and Front (upper z).",
          this->prm,
          Patterns::Selection(all_condition_names<dim>()));
        add_parameter(
          face_names[face] + " velocity",
          velocity_texts_[face],
          "For the condition 'velocity': expressions in x, y, (z,) t for the "
          "components of the velocity of the soil at this face, separated by "
          "semicolons [m/s]; the word 'free' leaves a component alone. The "
          "face itself stays where it is.");
        add_parameter(
          face_names[face] + " traction",
          traction_texts_[face],
          "For the condition 'traction': expressions in x, y, (z,) t for the "
          "components of the force per area in contact, separated by "
          "semicolons [Pa].");
      }
    add_parameter("Write forces",
                  writes_forces_,
                  "Write boundaries.csv: the force of the soil on each face of "
                  "the mesh that has a condition.");
  }



  // Both faces are checked, so that the message names the periodic face.
  template <int dim>
  std::array<bool, dim>
  Boundaries<dim>::periodic_axes() const
  {
    std::array<bool, dim> axes;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        const unsigned int opposite = face ^ 1;
        axes[face / 2]              = (names_[face] == "periodic");
        AssertThrow(!axes[face / 2] || names_[opposite] == "periodic",
                    ExcUser("The face '" + face_names[face] +
                            "' is periodic, but the opposite face is not: "
                            "'Boundaries/" +
                            face_names[opposite] + "' is '" + names_[opposite] +
                            "'. Make both faces periodic or neither."));
      }
    return axes;
  }



  /// Throw ExcUser unless expressions are given exactly if the condition needs
  /// expressions. An unused expression is an error, too: the user believes that
  /// the expression acts.
  template <int dim>
  void
  Boundaries<dim>::check_expression(const unsigned int face,
                                    const std::string &word,
                                    const std::string &expressions) const
  {
    const std::string parameter = "Boundaries/" + face_names[face];
    AssertThrow(names_[face] != word || !expressions.empty(),
                ExcUser(text("'",
                             parameter,
                             "' is '",
                             word,
                             "', but '",
                             parameter,
                             ' ',
                             word,
                             "' is empty; expected one expression for each "
                             "component, separated by semicolons. Give the "
                             "expressions.")));
    AssertThrow(names_[face] == word || expressions.empty(),
                ExcUser(text("'",
                             parameter,
                             ' ',
                             word,
                             " = ",
                             expressions,
                             "' is given, but '",
                             parameter,
                             "' is '",
                             names_[face],
                             "'; expected '",
                             word,
                             "'. Set this condition or remove the "
                             "expressions.")));
  }



  template <int dim>
  void
  Boundaries<dim>::check_expressions(const unsigned int face) const
  {
    check_expression(face, "velocity", velocity_texts_[face]);
    check_expression(face, "traction", traction_texts_[face]);
    const std::string &traction = traction_texts_[face];
    // The parser of expressions does not know the word and would not explain
    // the error.
    AssertThrow(traction.find("free") == std::string::npos,
                ExcUser(text("'Boundaries/",
                             face_names[face],
                             " traction = ",
                             traction,
                             "' contains the word 'free', allowed only for "
                             "velocities. Give 0 for a component without "
                             "traction.")));
  }



  /// Make the conditions, sorted by kind, then by face.
  template <int dim>
  void
  Boundaries<dim>::make_conditions(const Constants &constants)
  {
    conditions_.clear();
    for (const ConditionKind<dim> &kind : condition_kinds<dim>())
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (kind.make != nullptr && names_[face] == kind.name)
          conditions_.push_back(kind.make(
            {face, velocity_texts_[face], traction_texts_[face], constants}));
  }



  // Expressions are parsed after all parameters are known, because constants
  // may stand anywhere in the file.
  template <int dim>
  void
  Boundaries<dim>::parse(const Constants          &constants,
                         const SurfaceSource<dim> *surfaces)
  {
    for (unsigned int face = 0; face < 2 * dim; ++face)
      check_expressions(face);
    seabed_.prepare(constants, surfaces);
    AssertThrow(seabed_.limits_shear_stress(),
                ExcUser("'Boundaries/Seabed/Maximum shear stress' is empty, "
                        "where a number or an expression was expected. Give a "
                        "stress in Pa."));
    AssertThrow(has_seabed() || !seabed_.softens(),
                ExcUser("'Boundaries/Seabed/Slip to remould' is given, but no "
                        "face of the mesh is a seabed. Give the entry in the "
                        "section of an obstacle, set 'seabed' at a face, or "
                        "remove the entry."));
    make_conditions(constants);
    std::vector<unsigned int> faces;
    for (const auto &condition : conditions_)
      faces.push_back(condition->face());
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (is_seabed(face))
        faces.push_back(face);
    reactions_.prepare(faces, writes_forces_);
  }



  template <int dim>
  void
  Boundaries<dim>::list_state(StateList &list)
  {
    reactions_.list_state(list);
  }



  template class Boundaries<2>;
  template class Boundaries<3>;
} // namespace talus
