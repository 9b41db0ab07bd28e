// SPDX-License-Identifier: LGPL-2.1-or-later
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
  Bed<dim>::prepare(const Constants &constants)
  {
    check();
    cap_.reset();
    if (limits_shear_stress())
      cap_ = std::make_unique<ShearStressCap<dim>>("'" + section_ +
                                                     "/Maximum shear stress'",
                                                   maximum_shear_stress_text_,
                                                   constants);
  }



  template <int dim>
  double
  Bed<dim>::maximum_shear_stress(const Point<dim> &x) const
  {
    return cap_ ? cap_->at(x) : std::numeric_limits<double>::infinity();
  }



  template class Bed<2>;
  template class Bed<3>;
} // namespace talus
