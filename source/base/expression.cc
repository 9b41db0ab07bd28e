// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/did_you_mean.h>
#include <talus/base/errors.h>
#include <talus/base/expression.h>

#include <deal.II/base/mu_parser_internal.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <regex>

namespace talus
{
  using namespace dealii;

  namespace
  {
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



  namespace
  {
    /// Return @p base to the power of @p exponent. Squares and cubes are
    /// frequent, and products cost less than std::pow().
    double
    power_of(const double base, const double exponent)
    {
      return exponent == 2.   ? base * base
             : exponent == 3. ? base * base * base
                              : std::pow(base, exponent);
    }
  } // namespace



  /// An expression with the functions of deal.II's FunctionParser, whose values
  /// take a lock each.
  struct Formula
  {
    /// Parse @p expression; the first evaluation finds the errors. The operator
    /// ^ is then called ** because muParser does not replace operators of its
    /// own.
    Formula(const std::vector<std::string>      &names,
            std::string                          expression,
            const std::map<std::string, double> &constants)
      : variables(names.size())
    {
      try
        {
          define(names, constants);
          // deal.II permits spaces behind the names of functions.
          for (const auto &name :
               internal::FunctionParser::get_function_names())
            expression =
              std::regex_replace(expression, std::regex(name + "\\s+"), name);
          parser.SetExpr(expression);
          parser.Eval();
          parser.SetExpr(
            std::regex_replace(expression, std::regex("\\^"), "**"));
        }
      catch (const mu::ParserError &exception)
        {
          error = Utilities::trim(exception.GetMsg());
          if (!error.empty() && error.back() != '.')
            error += '.';
        }
    }

    void
    define(const std::vector<std::string>      &names,
           const std::map<std::string, double> &constants)
    {
      using namespace internal::FunctionParser;
      for (const auto &[name, value] : constants)
        parser.DefineConst(name, value);
      for (unsigned int i = 0; i < names.size(); ++i)
        parser.DefineVar(names[i], &variables[i]);
      parser.DefineOprt("|", mu_or, 1);
      parser.DefineOprt("&", mu_and, 2);
      parser.DefineOprt("**", power_of, mu::prPOW, mu::oaRIGHT);
      parser.DefineFun("if", mu_if);
      parser.DefineFun("int", mu_int);
      parser.DefineFun("ceil", mu_ceil);
      parser.DefineFun("cot", mu_cot);
      parser.DefineFun("csc", mu_csc);
      parser.DefineFun("floor", mu_floor);
      parser.DefineFun("sec", mu_sec);
      parser.DefineFun("log", mu_log);
      parser.DefineFun("pow", mu_pow);
      parser.DefineFun("erfc", mu_erfc);
      parser.DefineFun("rand_seed", mu_rand_seed, false);
      parser.DefineFun("rand", mu_rand, false);
    }

    std::vector<double> variables;
    std::string         error; ///< empty without error
    mu::Parser          parser;
  };



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
        Formula      value({}, expression, values);
        std::string  error  = value.error;
        const double number = error.empty() ? value.parser.Eval() : 0.;
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
    std::string error;
    for (const auto &part : Utilities::split_string_list(expressions, ';'))
      {
        formulas_.push_back(std::make_shared<Formula>(names, part, known));
        if (error.empty())
          error = formulas_.back()->error;
      }
    if (error.empty())
      return;
    std::vector<std::string> list;
    std::string              expected;
    for (const auto *const some : {&names, &other_names})
      for (const std::string &known_name : *some)
        if (std::find(list.begin(), list.end(), known_name) == list.end())
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



    /// Return the place of a value for messages, in words.
    std::string
    place_of(const std::string             &variables,
             const ArrayView<const double> &values)
    {
      const std::size_t size = variables.size();
      const bool        has_time =
        size > 2 && variables.compare(size - 2, 2, ",t") == 0;
      std::string numbers;
      for (std::size_t i = 0; i + has_time < values.size(); ++i)
        numbers += text(i > 0 ? " " : "", values[i]);
      return has_time ? text(" at (",
                             numbers,
                             ") m, t = ",
                             values[values.size() - 1],
                             " s")
                      : text(" with (", variables, ") = (", numbers, ')');
    }
  } // namespace



  template <int dim>
  double
  Expression<dim>::value(const Point<dim>  &x,
                         const double       t,
                         const unsigned int component)
  {
    Formula &formula = *formulas_[component];
    for (unsigned int d = 0; d < dim; ++d)
      formula.variables[d] = x[d];
    formula.variables[dim] = t;
    return formula.parser.Eval();
  }



  template <int dim>
  double
  Expression<dim>::finite_value(const Point<dim>  &x,
                                const double       t,
                                const unsigned int component)
  {
    std::array<double, dim + 1> arguments;
    std::copy(x.begin_raw(), x.end_raw(), arguments.begin());
    arguments[dim] = t;
    return finite_value(ArrayView<const double>(arguments), component);
  }



  /// An error may depend on position and time, as for the root of a negative
  /// number: ExcPoint, which also writes the last state.
  template <int dim>
  double
  Expression<dim>::finite_value(const ArrayView<const double> &arguments,
                                const unsigned int             component)
  {
    Formula &formula = *formulas_[component];
    AssertDimension(arguments.size(), formula.variables.size());
    std::copy(arguments.begin(), arguments.end(), formula.variables.begin());
    const double result = formula.parser.Eval();
    AssertThrow(std::isfinite(result),
                ExcPoint(text(name_,
                              " = '",
                              expressions_,
                              "' is ",
                              result,
                              place_of(variables_, arguments),
                              "; expected a finite number. Correct the "
                              "expression.")));
    AssertThrow(std::abs(result) <= largest_value,
                ExcPoint(
                  text(name_,
                       " = '",
                       expressions_,
                       "' is ",
                       result,
                       place_of(variables_, arguments),
                       ", which is larger than any quantity in SI units: "
                       "at most ",
                       largest_value,
                       " was expected. Correct the expression.")));
    return result;
  }



  template class Expression<2>;
  template class Expression<3>;
} // namespace talus
