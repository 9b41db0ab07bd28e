// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_expression_h
#define talus_base_expression_h

#include <deal.II/base/function_parser.h>
#include <deal.II/base/parameter_acceptor.h>

#include <map>
#include <string>

namespace talus
{
  /// Numbers that the user gives names to, for the expressions of the
  /// parameter file.
  class Constants : public dealii::ParameterAcceptor
  {
  public:
    Constants();

    /// The constants by name, with pi. Throws ExcUser if the parameter cannot
    /// be understood.
    std::map<std::string, double>
    values() const;

  private:
    std::string definitions_;
  };



  /// Function of place and time given by the user, one expression for each
  /// component, separated by semicolons. Variables: x, y (, z), t, or others of
  /// the same number; constants: pi and those of the user; functions: those of
  /// muParser.
  template <int dim>
  class Expression
  {
  public:
    /// @p name of the parameter, for messages. Throws ExcUser if there is not
    /// one expression for each component, or if one cannot be parsed.
    /// @p variables are names other than x, y (, z), t, separated by commas;
    /// nobody is told of those that begin with 'unused'.
    Expression(const std::string &name,
               const std::string &expressions,
               unsigned int       n_components,
               const Constants   &constants,
               const std::string &variables = dim == 2 ? "x,y,t" : "x,y,z,t");

    /// Value of one component at @p x and time @p t.
    double
    value(const dealii::Point<dim> &x,
          const double              t,
          const unsigned int        component)
    {
      function_.set_time(t);
      return function_.value(x, component);
    }

    /// The same, but throws ExcPoint if it is not finite.
    double
    finite_value(const dealii::Point<dim> &x, double t, unsigned int component);

  private:
    std::string                 name_;
    std::string                 expressions_;
    std::string                 variables_;
    dealii::FunctionParser<dim> function_;
  };
} // namespace talus

#endif
