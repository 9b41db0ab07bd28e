// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/materials/hencky.h>
#include <talus/materials/hencky_kernel.h>
#include <talus/materials/hyperelastic_law.templates.h>

namespace talus
{
  template <int dim>
  Hencky<dim>::Hencky(const std::string &section)
    : HyperelasticLaw<dim, HenckyEnergy>(section)
  {}



  // The formulas are in hencky_kernel.h; loops, tangent and load steps are in
  // the base class.
  template <int dim>
  HenckyEnergy
  Hencky<dim>::strain_energy() const
  {
    return {this->moduli()};
  }



  template class Hencky<2>;
  template class Hencky<3>;
} // namespace talus
