// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/expression.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// muParser reads an expression when it is first used: do that now. Returns
    /// its error, or nothing. Only the caller knows the parameter's name,
    /// hence the catch; deal.II prints details before it throws, hence the
    /// silence.
    template <int dim>
    std::string
    parse_error(const FunctionParser<dim> &function)
    {
      std::ostringstream    details;
      std::streambuf *const terminal = std::cerr.rdbuf(details.rdbuf());
      std::string           error;
      try
        {
          for (unsigned int c = 0; c < function.n_components; ++c)
            function.value(Point<dim>(), c);
        }
      catch (const ExceptionBase &exception)
        {
          std::ostringstream reason;
          exception.print_info(reason);
          error = std::regex_replace(Utilities::trim(reason.str()),
                                     std::regex("^Parsing Error at Column "
                                                "\\d+\\. The parser said: "),
                                     "");
          if (!error.empty() && error.back() != '.')
            error += '.';
        }
      std::cerr.rdbuf(terminal);
      return error;
    }



    /// Whether there is a single =, which muParser takes as an assignment.
    bool
    has_assignment(const std::string &expression)
    {
      for (std::size_t i = 0; i < expression.size(); ++i)
        if (expression[i] == '=')
          {
            const char before = (i > 0 ? expression[i - 1] : ' ');
            if (before == '<' || before == '>' || before == '!')
              continue;
            if (i + 1 == expression.size() || expression[i + 1] != '=')
              return true;
            ++i;
          }
      return false;
    }



    /// Whether there is a comma that does not stand between the arguments of a
    /// function: muParser takes what stands before it, and drops it.
    bool
    has_loose_comma(const std::string &expression)
    {
      int depth = 0;
      for (const char c : expression)
        {
          depth += (c == '(') - (c == ')');
          if (c == ',' && depth <= 0)
            return true;
        }
      return false;
    }



    /// Whether a constant may be called so: a word that muParser reads as one
    /// name, and that is neither a variable nor a constant defined before.
    bool
    is_new_name(const std::string                   &name,
                const std::map<std::string, double> &known)
    {
      const auto is_letter = [](const unsigned char c) {
        return std::isalpha(c) || c == '_';
      };
      const auto is_part = [&](const unsigned char c) {
        return is_letter(c) || std::isdigit(c);
      };
      const bool is_variable =
        (name == "x" || name == "y" || name == "z" || name == "t");
      return !name.empty() && is_letter(name[0]) &&
             std::all_of(name.begin(), name.end(), is_part) && !is_variable &&
             known.count(name) == 0;
    }
  } // namespace



  Constants::Constants()
    : ParameterAcceptor("/")
  {
    add_parameter("Constants",
                  definitions_,
                  "Numbers for the expressions of this file, as name = value, "
                  "separated by semicolons; a value may be an expression in "
                  "pi and the names before it: L = 25; b = pi/(2*L).");
  }



  /// In the order in which they are written: a value may use the constants
  /// before it, as muParser replaces only names it is given. A name that is
  /// defined twice is an error, not a new value, since either of them could be
  /// what was meant.
  std::map<std::string, double>
  Constants::values() const
  {
    std::map<std::string, double> values = {{"pi", numbers::PI}};
    for (const auto &definition :
         Utilities::split_string_list(definitions_, ';'))
      {
        const auto        equals = definition.find('=');
        const std::string name = Utilities::trim(definition.substr(0, equals));
        AssertThrow(equals != std::string::npos && is_new_name(name, values),
                    ExcUser(text("'Constants' contains '",
                                 definition,
                                 "', where 'name = value' was expected with a "
                                 "new name of letters, digits and '_' other "
                                 "than pi, x, y, z, t; separate constants by "
                                 "semicolons.")));
        const std::string expression =
          Utilities::trim(definition.substr(equals + 1));
        AssertThrow(!expression.empty() && !has_assignment(expression) &&
                      !has_loose_comma(expression),
                    ExcUser(text("'Constants' contains '",
                                 definition,
                                 "', where one value was expected behind "
                                 "the first =; write decimals with a point and "
                                 "separate constants by semicolons.")));
        FunctionParser<1> value(1);
        // deal.II wants a variable, which must be none that a user may mean: x
        // would be 0 without a word.
        value.initialize("unused_variable", expression, values);
        // An expression without variables has one value; where it is asked for
        // does not matter.
        std::string  error  = parse_error(value);
        const double number = error.empty() ? value.value(Point<1>()) : 0.;
        if (!std::isfinite(number))
          error = text("it is ", number, '.');
        AssertThrow(error.empty(),
                    ExcUser(text("'Constants' contains '",
                                 definition,
                                 "', whose value cannot be understood: ",
                                 error,
                                 " A finite expression in pi and the constants "
                                 "before it was expected; correct it.")));
        values[name] = number;
      }
    return values;
  }



  namespace
  {
    /// What muParser would take for something else than the user meant.
    void
    check_form(const std::string &name,
               const std::string &expressions,
               const unsigned int n_components)
    {
      const auto parts = Utilities::split_string_list(expressions, ';');
      AssertThrow(parts.size() == n_components,
                  ExcUser(text(name,
                               " = '",
                               expressions,
                               "' has ",
                               parts.size(),
                               " components, but ",
                               n_components,
                               " are needed, separated by semicolons.")));
      AssertThrow(!has_assignment(expressions),
                  ExcUser(
                    text(name,
                         " = '",
                         expressions,
                         "' gives a variable a value by =, where a formula "
                         "was expected; compare by == and define names in "
                         "'Constants'.")));
      AssertThrow(!has_loose_comma(expressions),
                  ExcUser(
                    text(name,
                         " = '",
                         expressions,
                         "' has a comma outside of a function's arguments, "
                         "where one formula for each component was "
                         "expected. Separate components by semicolons and "
                         "write decimals with a point.")));
    }
  } // namespace



  /// Parsed, and with that checked, here and not when the first value is
  /// needed, which may be hours later, and then in the middle of a step.
  template <int dim>
  Expression<dim>::Expression(const std::string &name,
                              const std::string &expressions,
                              const unsigned int n_components,
                              const Constants   &constants,
                              const std::string &variables)
    : name_(name)
    , expressions_(expressions)
    , variables_(variables)
    , function_(n_components)
  {
    check_form(name, expressions, n_components);
    const auto known = constants.values();
    const auto names = Utilities::split_string_list(variables, ',');
    for (const std::string &variable : names)
      AssertThrow(known.count(variable) == 0,
                  ExcUser(text("'Constants' gives a value to '",
                               variable,
                               "', but in ",
                               name,
                               " that is a variable. Give the constant "
                               "another name.")));
    function_.initialize(variables,
                         expressions,
                         known,
                         /*time_dependent=*/true);
    std::string known_names;
    for (const std::string &variable : names)
      if (variable.rfind("unused", 0) != 0)
        known_names += variable + ", ";
    const std::string error = parse_error(function_);
    AssertThrow(error.empty(),
                ExcUser(text(name,
                             " = '",
                             expressions,
                             "' cannot be understood: ",
                             error,
                             " An expression in ",
                             known_names,
                             "pi and the names of 'Constants' was expected; "
                             "correct it.")));
  }



  namespace
  {
    /// Largest magnitude, as of numbers in the parameter file.
    constexpr double largest_value = 1e30;



    template <int dim>
    std::string
    place_and_time(const std::string &variables,
                   const Point<dim>  &x,
                   const double       t)
    {
      return variables.back() == 't'
               ? text(" at (", x, ") m, t = ", t, " s")
               : text(" with (", variables, ") = (", x, ' ', t, ')');
    }
  } // namespace



  /// What is wrong may show only at some place and time of the run, as a root
  /// of a negative number does: hence ExcPoint, which also has the last state
  /// written.
  template <int dim>
  double
  Expression<dim>::finite_value(const Point<dim>  &x,
                                const double       t,
                                const unsigned int component)
  {
    const double result = value(x, t, component);
    AssertThrow(std::isfinite(result),
                ExcPoint(text(name_,
                              " = '",
                              expressions_,
                              "' is ",
                              result,
                              place_and_time(variables_, x, t),
                              ", where a finite number was expected; correct "
                              "the expression.")));
    AssertThrow(std::abs(result) <= largest_value,
                ExcPoint(
                  text(name_,
                       " = '",
                       expressions_,
                       "' is ",
                       result,
                       place_and_time(variables_, x, t),
                       ", which is larger than any quantity in SI units: "
                       "at most ",
                       largest_value,
                       " was expected. Correct the expression.")));
    return result;
  }



  template class Expression<2>;
  template class Expression<3>;
} // namespace talus
