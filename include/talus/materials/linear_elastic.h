// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_linear_elastic_h
#define talus_materials_linear_elastic_h

#include <talus/materials/rate_law.h>

namespace talus
{
  /// "linear elastic": Hooke's law between the Jaumann rate of the Cauchy
  /// stress and the rate of deformation. For small strains: in simple shear the
  /// stress is G sin(gamma), and only the volumetric part has an energy. See
  /// elastic_trial() for the integration.
  template <int dim>
  class LinearElastic : public RateLaw<dim, NoFlow>
  {
  public:
    LinearElastic(const std::string &section);

  private:
    NoFlow
    flow_rule(double dt) const override;
  };
} // namespace talus

#endif
