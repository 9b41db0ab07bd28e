// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/place_expression.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <regex>

namespace talus
{
  using namespace dealii;

  namespace
  {
    bool
    has_word(const std::string &words, const std::string &word)
    {
      return std::regex_search(words, std::regex("\\b" + word + "\\b"));
    }
  } // namespace



  template <int dim>
  PlaceExpression<dim>::PlaceExpression(const std::string        &path,
                                        const std::string        &words,
                                        const Constants          &constants,
                                        const std::vector<Named> &known,
                                        const Variables           variables)
    : variables_(variables)
  {
    if (Patterns::Double().match(words))
      {
        number_ = Utilities::string_to_double(words);
        return;
      }
    std::string names = variables == Variables::plan ? "x" : "x,y";
    names += dim == 3 ? ",z" : "";
    if (variables >= Variables::space_and_depth)
      {
        names += ",depth";
        depends_on_depth_ = has_word(words, "depth");
      }
    if (variables == Variables::space_depth_and_overburden)
      names += ",overburden";
    std::vector<std::string> known_names;
    for (const Named &surface : known)
      {
        known_names.push_back(surface.first);
        if (!has_word(words, surface.first))
          continue;
        surfaces_.push_back(surface);
        names += "," + surface.first;
      }
    expression_.emplace(path, words, 1, constants, names, known_names);
  }



  // The mudline is searched only if the expression uses the depth.
  template <int dim>
  double
  PlaceExpression<dim>::at(const Point<dim> &x, const double overburden) const
  {
    if (number_)
      return *number_;
    Arguments arguments;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != 1 || variables_ != Variables::plan)
        arguments.push_back(x[d]);
    if (variables_ >= Variables::space_and_depth)
      arguments.push_back(depends_on_depth_ ? depth_(x) : 0.);
    if (variables_ == Variables::space_depth_and_overburden)
      arguments.push_back(overburden);
    for (const Named &surface : surfaces_)
      arguments.push_back(surface.second->height(x));
    return evaluate(arguments);
  }



  template <int dim>
  double
  PlaceExpression<dim>::evaluate(const Arguments &arguments) const
  {
    return number_
             ? *number_
             : expression_->finite_value(
                 ArrayView<const double>(arguments.data(), arguments.size()));
  }



  template class PlaceExpression<2>;
  template class PlaceExpression<3>;
} // namespace talus
