// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/bed.h>

#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Bed<dim>::Bed(const std::string &section,
                const std::string &maximum_shear_stress,
                const std::string &description)
    : InterfaceFriction(section)
    , section_(section.substr(1))
    , maximum_shear_stress_text_(maximum_shear_stress)
  {
    add_parameter("Maximum shear stress",
                  maximum_shear_stress_text_,
                  description);
  }



  template <int dim>
  void
  Bed<dim>::prepare(const Constants          &constants,
                    const SurfaceSource<dim> *surfaces)
  {
    check();
    cap_.reset();
    if (!limits_shear_stress())
      return;
    std::vector<typename Surface<dim>::Named> named;
    if (surfaces != nullptr)
      named = surfaces->named();
    cap_.emplace("'" + section_ + "/Maximum shear stress'",
                 maximum_shear_stress_text_,
                 constants,
                 named);
    if (cap_->number())
      maximum_shear_stress({}); // throws here if it is negative
  }



  template <int dim>
  double
  Bed<dim>::maximum_shear_stress(const Point<dim> &x) const
  {
    if (!cap_)
      return std::numeric_limits<double>::infinity();
    const double value = cap_->at(x);
    AssertThrow(value >= 0.,
                ExcUser(text("'",
                             section_,
                             "/Maximum shear stress' = ",
                             maximum_shear_stress_text_,
                             " is ",
                             value,
                             " Pa",
                             cap_->number() ? "" : text(" at (", x, ") m"),
                             ", but a shear stress that resists sliding cannot "
                             "be negative. Correct the value.")));
    return value;
  }



  template class Bed<2>;
  template class Bed<3>;
} // namespace talus
