// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/did_you_mean.h>
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
    /// Return the parse error of an expression; empty without error. muParser
    /// parses at the first evaluation, so the function evaluates once. The
    /// exception is caught because only the caller knows the name of the
    /// parameter; std::cerr is silenced because deal.II prints details before
    /// the exception.
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



    /// Whether the expression contains a single =, an assignment in muParser.
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



    /// Whether the expression contains a comma outside of function arguments:
    /// muParser would drop the part before the comma.
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



    /// Whether @p name is a valid new name of a constant: a single name for
    /// muParser, neither a variable nor a known constant.
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
                  "Named constants for the expressions of this file, as name = "
                  "value, separated by semicolons. A value may be an "
                  "expression in pi and names defined before: L = 25; b = "
                  "pi/(2*L).");
  }



  /// Definitions are evaluated in their order: a value may use earlier
  /// constants, the only names muParser knows. A second definition of a name is
  /// an error, not a new value, since the user may have meant either.
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
                                 "'; expected 'name = value' with a new name "
                                 "of letters, digits and '_' other than pi, x, "
                                 "y, z, t. Separate constants by "
                                 "semicolons.")));
        const std::string expression =
          Utilities::trim(definition.substr(equals + 1));
        AssertThrow(!expression.empty() && !has_assignment(expression) &&
                      !has_loose_comma(expression),
                    ExcUser(text("'Constants' contains '",
                                 definition,
                                 "'; expected one value after the first =. "
                                 "Write decimals with a point and separate "
                                 "constants by semicolons.")));
        FunctionParser<1> value(1);
        // deal.II needs a variable. A name of the user must not match: x would
        // silently be 0.
        value.initialize("unused_variable", expression, values);
        // Without variables the value does not depend on the position.
        std::string  error  = parse_error(value);
        const double number = error.empty() ? value.value(Point<1>()) : 0.;
        if (!std::isfinite(number))
          error = text("it is ", number, '.');
        AssertThrow(error.empty(),
                    ExcUser(text("'Constants' contains '",
                                 definition,
                                 "', whose value cannot be understood: ",
                                 error,
                                 " Expected a finite expression in pi and "
                                 "constants defined before.")));
        values[name] = number;
      }
    return values;
  }



  namespace
  {
    /// Reject forms that muParser would interpret differently from the user.
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
                         "' assigns a value by =; expected a formula. Compare "
                         "by == and define names in 'Constants'.")));
      AssertThrow(!has_loose_comma(expressions),
                  ExcUser(
                    text(name,
                         " = '",
                         expressions,
                         "' has a comma outside of a function's arguments; "
                         "expected one formula for each component. Separate "
                         "components by semicolons and write decimals with a "
                         "point.")));
    }
  } // namespace



  /// Expressions are parsed, and thereby checked, at construction and not at
  /// the first evaluation, perhaps hours later in the middle of a step.
  template <int dim>
  Expression<dim>::Expression(const std::string              &name,
                              const std::string              &expressions,
                              const unsigned int              n_components,
                              const Constants                &constants,
                              const std::string              &variables,
                              const std::vector<std::string> &other_names)
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
                               " the name is a variable. Give the constant "
                               "another name.")));
    function_.initialize(variables,
                         expressions,
                         known,
                         /*time_dependent=*/true);
    const std::string error = parse_error(function_);
    if (error.empty())
      return;
    std::vector<std::string> list;
    std::string              expected;
    for (const auto *const some : {&names, &other_names})
      for (const std::string &known_name : *some)
        if (known_name.rfind("unused", 0) != 0 &&
            std::find(list.begin(), list.end(), known_name) == list.end())
          {
            list.push_back(known_name);
            expected += known_name + ", ";
          }
    for (const auto &constant : known)
      list.push_back(constant.first);
    static const std::regex quoted(".*\"(.*)\".*");
    std::smatch             word;
    std::regex_match(error, word, quoted);
    AssertThrow(false,
                ExcUser(text(name,
                             " = '",
                             expressions,
                             "' cannot be understood: ",
                             error,
                             " Expected an expression in ",
                             expected,
                             "pi and the names of 'Constants'.",
                             did_you_mean(word.size() > 1 ? word[1].str() : "",
                                          list))));
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



  /// An error may depend on position and time, as for the root of a negative
  /// number: ExcPoint, which also writes the last state.
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
                              "; expected a finite number. Correct the "
                              "expression.")));
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
