// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/materials/linear_elastic.h>
#include <talus/materials/rate_law.templates.h>

namespace talus
{
  // Elastic: there is no plastic variable.
  template <int dim>
  LinearElastic<dim>::LinearElastic(const std::string &section)
    : RateLaw<dim, NoFlow>(section)
  {}



  // Rate laws share Hooke's law in rate form; here nothing flows.
  template <int dim>
  NoFlow
  LinearElastic<dim>::flow_rule(const double /*dt*/) const
  {
    return {};
  }



  template class LinearElastic<2>;
  template class LinearElastic<3>;
} // namespace talus
