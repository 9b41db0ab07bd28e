// The part of Boundaries that understands the parameters.

#include <talus/base/errors.h>
#include <talus/boundaries/boundaries.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

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



  template Boundaries<2>::Boundaries();
  template Boundaries<3>::Boundaries();
  template std::array<bool, 2>
  Boundaries<2>::periodic_axes() const;
  template std::array<bool, 3>
  Boundaries<3>::periodic_axes() const;
  template void
  Boundaries<2>::prepare(const Constants &);
  template void
  Boundaries<3>::prepare(const Constants &);
} // namespace talus
