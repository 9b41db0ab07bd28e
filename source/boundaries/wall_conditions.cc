// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/wall_conditions.h>
#include <talus/grid/mesh_layout.h>

#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the expressions with 'free' replaced by 0, which is never
    /// evaluated.
    std::string
    without_free(const std::string &expressions)
    {
      std::string result;
      for (const std::string &part :
           Utilities::split_string_list(expressions, ';'))
        result += (result.empty() ? "" : ";") +
                  std::string(part == "free" ? "0" : part);
      return result;
    }
  } // namespace



  // A single parser for all components, also free ones, checks the number of
  // expressions.
  template <int dim>
  FaceExpression<dim>::FaceExpression(const std::string &name,
                                      const std::string &expressions,
                                      const Constants   &constants,
                                      const bool         may_be_free)
    : expression_(name,
                  may_be_free ? without_free(expressions) : expressions,
                  dim,
                  constants)
  {
    const auto parts = Utilities::split_string_list(expressions, ';');
    for (unsigned int d = 0; d < dim; ++d)
      is_prescribed_[d] = !(may_be_free && parts[d] == "free");
  }



  template class FaceExpression<2>;
  template class FaceExpression<3>;



  template <int dim>
  void
  RollerCondition<dim>::constrain(const Point<dim> & /*x*/,
                                  const double /*t*/,
                                  const unsigned int        owner,
                                  VelocityConstraints<dim> &constraints)
  {
    constraints.set({Point<dim>::unit_vector(this->face() / 2), 0., owner});
  }



  template <int dim>
  void
  FixedCondition<dim>::constrain(const Point<dim> & /*x*/,
                                 const double /*t*/,
                                 const unsigned int        owner,
                                 VelocityConstraints<dim> &constraints)
  {
    for (unsigned int d = 0; d < dim; ++d)
      constraints.set({Point<dim>::unit_vector(d), 0., owner});
  }



  template <int dim>
  VelocityCondition<dim>::VelocityCondition(
    const FaceDescription<dim> &description)
    : BoundaryCondition<dim>(description)
    , expression_("'Boundaries/" + face_names[description.face] + " velocity'",
                  description.velocity,
                  description.constants,
                  /*may_be_free=*/true)
  {}



  template <int dim>
  void
  VelocityCondition<dim>::constrain(const Point<dim>         &x,
                                    const double              t,
                                    const unsigned int        owner,
                                    VelocityConstraints<dim> &constraints)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (const Tensor<1, dim> axis = Point<dim>::unit_vector(d);
          expression_.prescribes(d) &&
          (!constraints.has(axis) || d == this->face() / 2))
        constraints.set({axis, expression_.value(x, t, d), owner});
  }



  template <int dim>
  TractionCondition<dim>::TractionCondition(
    const FaceDescription<dim> &description)
    : BoundaryCondition<dim>(description)
    , expression_("'Boundaries/" + face_names[description.face] + " traction'",
                  description.traction,
                  description.constants,
                  /*may_be_free=*/false)
  {}



  template <int dim>
  Tensor<1, dim>
  TractionCondition<dim>::traction(const Point<dim> &x, const double t)
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = expression_.value(x, t, d);
    return result;
  }



  template class RollerCondition<2>;
  template class RollerCondition<3>;
  template class FixedCondition<2>;
  template class FixedCondition<3>;
  template class VelocityCondition<2>;
  template class VelocityCondition<3>;
  template class TractionCondition<2>;
  template class TractionCondition<3>;
} // namespace talus
