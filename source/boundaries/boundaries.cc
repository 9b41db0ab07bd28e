// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/contact_area.h>
#include <talus/grid/node_places.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  // Without one, a trigger or a strength reduction that is to weaken it has
  // nothing to act on.
  template <int dim>
  bool
  Boundaries<dim>::has_seabed() const
  {
    return std::count(conditions_.begin(),
                      conditions_.end(),
                      FaceCondition::seabed) > 0;
  }



  // A pass over all owned cells, and a place per node: spared where no
  // expression asks for it.
  template <int dim>
  void
  Boundaries<dim>::locate_nodes(const Grid<dim> &grid)
  {
    places_.clear();
    const auto is_given = [](const auto &expression) {
      return expression != nullptr;
    };
    if (std::none_of(velocities_.begin(), velocities_.end(), is_given) &&
        std::none_of(tractions_.begin(), tractions_.end(), is_given))
      return;
    places_ = places_of_owned_nodes(grid);
  }



  /// Call action(face) for those of @p faces (see Grid::faces_of_node()) with
  /// this condition, in the order of the faces.
  template <int dim>
  template <typename Action>
  void
  Boundaries<dim>::for_faces_with(const FaceCondition condition,
                                  const unsigned char faces,
                                  const Action       &action) const
  {
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if ((faces & (1u << face)) && conditions_[face] == condition)
        action(face);
  }



  // By the condition alone, whatever the soil does: for the static stages,
  // whose unknowns these components are not.
  template <int dim>
  unsigned char
  Boundaries<dim>::components_constrained_by_walls(
    const unsigned char faces) const
  {
    unsigned char result = 0;
    for_faces_with(FaceCondition::fixed, faces, [&](unsigned int) {
      result = (1u << dim) - 1;
    });
    for_faces_with(FaceCondition::roller, faces, [&](const unsigned int face) {
      result |= 1u << (face / 2);
    });
    for_faces_with(FaceCondition::velocity,
                   faces,
                   [&](const unsigned int face) {
                     for (unsigned int d = 0; d < dim; ++d)
                       if (velocities_[face]->prescribes(d))
                         result |= 1u << d;
                   });
    return result;
  }



  // The seabed may hold all components or none, as the soil pushes: who asks
  // here leaves them all alone.
  template <int dim>
  unsigned char
  Boundaries<dim>::constrained_components(const unsigned char faces) const
  {
    unsigned char result = components_constrained_by_walls(faces);
    for_faces_with(FaceCondition::seabed, faces, [&](unsigned int) {
      result = (1u << dim) - 1;
    });
    return result;
  }



  template <int dim>
  void
  Boundaries<dim>::PrescribedVelocity::set(const unsigned int component,
                                           const double       value)
  {
    is_prescribed[component] = true;
    velocity[component]      = value;
  }



  template <int dim>
  Tensor<1, dim>
  Boundaries<dim>::PrescribedVelocity::impose(NodalFields<dim>  &nodes,
                                              const unsigned int node) const
  {
    Tensor<1, dim> v = nodes.velocity(node);
    for (unsigned int d = 0; d < dim; ++d)
      if (is_prescribed[d])
        v[d] = velocity[d];
    return nodes.set_velocity(node, v);
  }



  /// What walls prescribe for a node on these faces at time @p t.
  /// The order of the loops is the order of precedence: what comes later
  /// overrides. Velocities first, of which the one whose normal the component
  /// is counts most, then the first face; then rollers, since nothing may pass
  /// a wall, whatever another face prescribes; then `fixed`, which holds all
  /// (doc/method.md, section 5).
  template <int dim>
  typename Boundaries<dim>::PrescribedVelocity
  Boundaries<dim>::prescribed_velocity(const unsigned char faces,
                                       const unsigned int  node,
                                       const double        t)
  {
    PrescribedVelocity prescribed;
    for_faces_with(
      FaceCondition::velocity, faces, [&](const unsigned int face) {
        for (unsigned int d = 0; d < dim; ++d)
          if (velocities_[face]->prescribes(d) &&
              (!prescribed.is_prescribed[d] || d == face / 2))
            prescribed.set(d, velocities_[face]->value(places_[node], t, d));
      });
    for_faces_with(FaceCondition::roller, faces, [&](const unsigned int face) {
      prescribed.set(face / 2, 0.);
    });
    for_faces_with(FaceCondition::fixed, faces, [&](unsigned int) {
      for (unsigned int d = 0; d < dim; ++d)
        prescribed.set(d, 0.);
    });
    return prescribed;
  }



  template <int dim>
  Tensor<1, dim>
  Boundaries<dim>::impose_walls(NodalFields<dim>   &nodes,
                                const unsigned char faces,
                                const unsigned int  node,
                                const double        t)
  {
    return prescribed_velocity(faces, node, t).impose(nodes, node);
  }



  // A traction is a force, so it goes into the momentum update and not into
  // what changes velocities after it: on a node that a wall holds it is then
  // simply borne by the wall. Its work is known only when all conditions have
  // acted, in apply(), hence the list.
  template <int dim>
  void
  Boundaries<dim>::add_tractions(NodalFields<dim> &nodes,
                                 const Grid<dim>  &grid,
                                 const double      t,
                                 const double      mass_cutoff)
  {
    loaded_.clear();
    if (std::count(conditions_.begin(),
                   conditions_.end(),
                   FaceCondition::traction) == 0)
      return;
    for (const unsigned int node : nodes.active_boundary_nodes())
      if (nodes.mass(node) > mass_cutoff)
        for_faces_with(FaceCondition::traction,
                       grid.faces_of_node(node),
                       [&](const unsigned int face) {
                         const double area =
                           contact_area(nodes, grid, face, node);
                         Tensor<1, dim> force;
                         for (unsigned int d = 0; d < dim; ++d)
                           force[d] =
                             area *
                             tractions_[face]->value(places_[node], t, d);
                         nodes.add_force(node, force);
                         loaded_.emplace_back(node, force);
                       });
  }



  /// Each condition changes the velocity, which takes an impulse; all works are
  /// impulse times the mean velocity of the step, after the last change. Only
  /// so do they add up, with the kinetic energy, to nothing: a work booked when
  /// the impulse acts would be taken with a velocity that the next condition
  /// changes.
  template <int dim>
  void
  Boundaries<dim>::apply_to_node(NodalFields<dim>  &nodes,
                                 const Grid<dim>   &grid,
                                 const unsigned int node,
                                 const double       t,
                                 const double       dt,
                                 Works<dim>        &work)
  {
    const unsigned char faces = grid.faces_of_node(node);
    Tensor<1, dim>      contact, friction, wall;

    // Walls before the seabed: what a wall holds must not use up the friction.
    const PrescribedVelocity prescribed =
      prescribed_velocity(faces, node, t + 0.5 * dt);
    wall += prescribed.impose(nodes, node);
    for_faces_with(FaceCondition::seabed, faces, [&](const unsigned int face) {
      const auto [normal, tangential] =
        seabed_.apply(nodes, grid, face, node, dt);
      contact += normal;
      friction += tangential;
    });
    // Nor does friction brake what a wall drives: the wall takes it up.
    wall += prescribed.impose(nodes, node);

    const Tensor<1, dim> v = nodes.mean_velocity(node);
    work.friction -= friction * v;
    work.contact -= (contact + wall) * v;
    work.seabed_impulse += contact + friction;
    work.wall_impulse += wall;
  }



  // Node by node: with the lumped mass none of them feels its neighbours, and
  // the order of the nodes does not matter but for the round-off in the sums.
  template <int dim>
  Works<dim>
  Boundaries<dim>::apply(NodalFields<dim> &nodes,
                         const Grid<dim>  &grid,
                         const double      t,
                         const double      dt,
                         const double      mass_cutoff)
  {
    Works<dim> work;
    for (const unsigned int node : nodes.active_boundary_nodes())
      if (nodes.mass(node) > mass_cutoff)
        apply_to_node(nodes, grid, node, t, dt, work);
    for (const auto &[node, force] : loaded_)
      {
        work.contact -= dt * force * nodes.mean_velocity(node);
        work.wall_impulse += dt * force;
      }
    return work;
  }



  namespace
  {
    // A new condition gets its name here; range and messages follow.
    const std::vector<std::pair<std::string, FaceCondition>> condition_names = {
      {"free", FaceCondition::free},
      {"roller", FaceCondition::roller},
      {"fixed", FaceCondition::fixed},
      {"seabed", FaceCondition::seabed},
      {"periodic", FaceCondition::periodic},
      {"velocity", FaceCondition::velocity},
      {"traction", FaceCondition::traction}};



    /// As the pattern of a selection.
    std::string
    all_condition_names()
    {
      std::string result;
      for (const auto &entry : condition_names)
        result += (result.empty() ? "" : "|") + entry.first;
      return result;
    }



    /// The word in the parameter file, for messages.
    std::string
    name_of(const FaceCondition condition)
    {
      return std::find_if(condition_names.begin(),
                          condition_names.end(),
                          [=](const auto &entry) {
                            return entry.second == condition;
                          })
        ->first;
    }



    /// The parser has made sure that it is one of the list.
    FaceCondition
    condition_by_name(const std::string &name)
    {
      return std::find_if(condition_names.begin(),
                          condition_names.end(),
                          [&](const auto &entry) {
                            return entry.first == name;
                          })
        ->second;
    }
  } // namespace



  // The expressions of a face are parameters of their own, and not a part of
  // the condition's text, so that an error names the parameter it is in, and
  // conditions can be a selection.
  template <int dim>
  Boundaries<dim>::Boundaries()
    : ParameterAcceptor("/Boundaries")
  {
    // A face that the file does not name is free: a point that crosses it ends
    // the run, so that a wall which was forgotten does not go unnoticed.
    names_.fill("free");
    conditions_.fill(FaceCondition::free);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        add_parameter(
          face_names[face],
          names_[face],
          "Condition on this face of the mesh: 'free' (a point that crosses it "
          "has left, which is an error), 'roller' (no motion along the "
          "normal), 'fixed' (no motion), 'seabed' (contact with friction, see "
          "the section Seabed), 'periodic' (what leaves here enters through "
          "the opposite face, which must be periodic, too), 'velocity' or "
          "'traction' (by the expressions of this face). In 3-D there are Back "
          "(lower z) and Front (upper z), too.",
          this->prm,
          Patterns::Selection(all_condition_names()));
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
    // Conditions are known from now on; the expressions wait for prepare().
    parse_parameters_call_back.connect([this]() {
      for (unsigned int face = 0; face < 2 * dim; ++face)
        conditions_[face] = condition_by_name(names_[face]);
    });
  }



  // Asked of both faces, so that the message names the one that is periodic.
  template <int dim>
  std::array<bool, dim>
  Boundaries<dim>::periodic_axes() const
  {
    std::array<bool, dim> axes;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        const unsigned int opposite = face ^ 1;
        axes[face / 2] = (conditions_[face] == FaceCondition::periodic);
        AssertThrow(!axes[face / 2] ||
                      conditions_[opposite] == FaceCondition::periodic,
                    ExcUser("The face '" + face_names[face] +
                            "' is periodic, but the opposite one is not: "
                            "'Boundaries/" +
                            face_names[opposite] + "' is '" + names_[opposite] +
                            "'. Make both faces periodic or neither."));
      }
    return axes;
  }



  /// The expression is there if, and only if, the condition needs it.
  /// An expression that is given in vain is an error, too: whoever wrote it
  /// believes that it acts.
  template <int dim>
  void
  Boundaries<dim>::check_expression(const unsigned int  face,
                                    const FaceCondition condition,
                                    const std::string  &expressions) const
  {
    const std::string parameter = "Boundaries/" + face_names[face];
    const std::string word      = name_of(condition);
    AssertThrow(conditions_[face] != condition || !expressions.empty(),
                ExcUser(text("'",
                             parameter,
                             "' is '",
                             word,
                             "', but '",
                             parameter,
                             ' ',
                             word,
                             "' is empty, where one expression for each "
                             "component was expected, separated by semicolons. "
                             "Give them.")));
    AssertThrow(conditions_[face] == condition || expressions.empty(),
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
                             "', where '",
                             word,
                             "' was expected. Set that or remove the "
                             "expressions.")));
  }



  // Expressions are parsed here, after all parameters are known: constants may
  // stand anywhere in the file.
  template <int dim>
  void
  Boundaries<dim>::prepare(const Constants &constants)
  {
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        const std::string name = "'Boundaries/" + face_names[face];
        check_expression(face, FaceCondition::velocity, velocity_texts_[face]);
        check_expression(face, FaceCondition::traction, traction_texts_[face]);
        const std::string &traction = traction_texts_[face];
        // The parser of expressions would not know the word, and would not say
        // why.
        AssertThrow(traction.find("free") == std::string::npos,
                    ExcUser(text(name,
                                 " traction = ",
                                 traction,
                                 "' contains the word 'free', which only a "
                                 "velocity may be. Give 0 for a component "
                                 "without traction.")));
        velocities_[face].reset();
        tractions_[face].reset();
        if (conditions_[face] == FaceCondition::velocity)
          velocities_[face] =
            std::make_unique<FaceExpression<dim>>(name + " velocity'",
                                                  velocity_texts_[face],
                                                  constants,
                                                  /*may_be_free=*/true);
        if (conditions_[face] == FaceCondition::traction)
          tractions_[face] =
            std::make_unique<FaceExpression<dim>>(name + " traction'",
                                                  traction,
                                                  constants,
                                                  /*may_be_free=*/false);
      }
  }



  template class Boundaries<2>;
  template class Boundaries<3>;
} // namespace talus
