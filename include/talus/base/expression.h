// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_expression_h
#define talus_base_expression_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Named constants of the user, for expressions in the parameter file.
  class Constants : public dealii::ParameterAcceptor
  {
  public:
    Constants();

    /// Return the constants by name, including pi. Throws ExcUser if a
    /// definition is invalid.
    std::map<std::string, double>
    values() const;

  private:
    std::string definitions_;
  };



  struct Formula;



  /// Function of position and time given by the user, with an expression per
  /// component, separated by semicolons. Variables: x, y (, z), t, or the same
  /// number of other names. Constants: pi and the constants of the user.
  /// Functions: all functions of muParser.
  template <int dim>
  class Expression
  {
  public:
    /// Parse the expressions. Throws ExcUser if the number of expressions is
    /// not @p n_components, or if parsing fails.
    ///
    /// @param name of the parameter, for messages
    /// @param expressions separated by semicolons
    /// @param n_components number of expressions required
    /// @param constants of the user
    /// @param variables names in place of x, y (, z), t, separated by commas
    /// @param other_names that would be allowed, for messages
    Expression(const std::string &name,
               const std::string &expressions,
               unsigned int       n_components,
               const Constants   &constants,
               const std::string &variables = dim == 2 ? "x,y,t" : "x,y,z,t",
               const std::vector<std::string> &other_names = {});

    /// Return the value of a component at @p x, m, and time @p t, s.
    double
    value(const dealii::Point<dim> &x, double t, unsigned int component);

    /// Return value(); throws ExcPoint if it is not finite.
    double
    finite_value(const dealii::Point<dim> &x, double t, unsigned int component);

    /// Return the value of a component for @p arguments, one per variable, in
    /// their order. Throws ExcPoint if it is not finite.
    double
    finite_value(const dealii::ArrayView<const double> &arguments,
                 unsigned int                           component = 0);

  private:
    std::string                           name_;
    std::string                           expressions_;
    std::string                           variables_;
    std::vector<std::shared_ptr<Formula>> formulas_; ///< by component
  };
} // namespace talus

#endif
