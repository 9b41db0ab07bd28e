// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/shear_stress_cap.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <regex>

namespace talus
{
  using namespace dealii;

  template <int dim>
  ShearStressCap<dim>::ShearStressCap(const std::string &path,
                                      const std::string &words,
                                      const Constants   &constants)
    : path_(path)
    , words_(words)
    , depends_on_depth_(std::regex_search(words, std::regex("\\bdepth\\b")))
  {
    if (Patterns::Double().match(words))
      number_ = checked(Utilities::string_to_double(words), "");
    else
      expression_ = std::make_unique<Expression<dim>>(
        path, words, 1, constants, dim == 2 ? "x,y,depth" : "x,y,z,depth");
  }



  template <int dim>
  double
  ShearStressCap<dim>::checked(const double       value,
                               const std::string &place) const
  {
    AssertThrow(value >= 0.,
                ExcUser(text(path_,
                             " = ",
                             words_,
                             " is ",
                             value,
                             " Pa",
                             place,
                             ", but a shear stress that resists sliding cannot "
                             "be negative. Correct the value.")));
    return value;
  }



  // The mudline is searched only if the expression uses the depth.
  template <int dim>
  double
  ShearStressCap<dim>::at(const Point<dim> &x) const
  {
    if (number_)
      return *number_;
    const double depth = depends_on_depth_ ? depth_(x) : 0.;
    const double value = expression_->finite_value(x, depth, 0);
    return value >= 0. ? value : checked(value, text(" at (", x, ") m"));
  }



  template class ShearStressCap<2>;
  template class ShearStressCap<3>;
} // namespace talus
