#ifndef talus_simulation_expression_h
#define talus_simulation_expression_h

#include <deal.II/base/function_parser.h>

#include <string>

namespace talus
{
  /// Function of place and time given by the user, one expression for each
  /// component, separated by semicolons. Variables: x, y (, z), t; constants:
  /// pi; functions: those of muParser.
  template <int dim>
  class Expression
  {
  public:
    /// @p name of the parameter, for messages. Throws ExcUser if there is not
    /// one expression for each component, or if one cannot be parsed.
    Expression(const std::string &name,
               const std::string &expressions,
               unsigned int       n_components);

    /// Value of one component at @p x and time @p t.
    double
    value(const dealii::Point<dim> &x,
          const double              t,
          const unsigned int        component)
    {
      function_.set_time(t);
      return function_.value(x, component);
    }

  private:
    dealii::FunctionParser<dim> function_;
  };
} // namespace talus

#endif
