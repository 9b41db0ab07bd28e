// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/materials/hyperelastic_law.templates.h>
#include <talus/materials/neo_hookean.h>
#include <talus/materials/neo_hookean_kernel.h>

namespace talus
{
  template <int dim>
  NeoHookean<dim>::NeoHookean(const std::string &section)
    : HyperelasticLaw<dim, NeoHookeanEnergy>(section)
  {}



  // The formula is in neo_hookean_kernel.h. NeoHookean is the smallest example
  // of a law with a strain energy (doc/architecture.md).
  template <int dim>
  NeoHookeanEnergy
  NeoHookean<dim>::strain_energy() const
  {
    return {this->moduli()};
  }



  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace talus
