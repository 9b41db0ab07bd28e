// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_herschel_bulkley_h
#define talus_materials_herschel_bulkley_h

#include <talus/materials/undrained_law.h>

namespace talus
{
  struct HerschelBulkleyFlow;

  /// Variants of the law with strength s_u + K gdot^n. Bingham: n = 1, and K is
  /// the viscosity.
  enum class FlowLaw
  {
    herschel_bulkley,
    bingham
  };



  /// "Herschel-Bulkley" and "Bingham": undrained clay whose strength grows with
  /// the shear rate and falls by remoulding. Elastic as LinearElastic up to the
  /// shear stress tau = sqrt(s:s/2) = s_u; beyond, plastic at constant volume
  /// with tau = s_u(xi) + K gdot^n. Here gdot = sqrt(2 Dp:Dp) is the plastic
  /// shear rate and xi its integral in time; in simple shear both refer to the
  /// engineering shear. Remoulding:
  ///   s_u(xi) = f s_u0 [r + (1 - r) exp(-3 xi/xi_95)] @cite einav2005,
  /// with the strength factor f of the point, or 1. With a softening
  /// displacement d, xi/xi_95 is the integral of h dxi/d, h the cell size of
  /// the point. Backward Euler, see plastic_shear(); in a step of length zero
  /// viscous material does not flow. With K = 0 and r = 1 the law is von Mises'
  /// law without hardening.
  template <int dim>
  class HerschelBulkley : public UndrainedLaw<dim, HerschelBulkleyFlow>
  {
  public:
    HerschelBulkley(const std::string &section, FlowLaw flow_law);

    void
    check() const override;

    double
    largest_strength_factor(const StrengthRange &range) const override;

    bool
    softens() const override;

    double
    fraction_of_strength_loss(const Points<dim> &points,
                              unsigned int       p) const override;

    Remark
    note(double cell_size) const override;

  private:
    double
    shear_per_plastic_variable() const override
    {
      return 1.;
    }

    std::string
    slower_softening(double times) const override;

    HerschelBulkleyFlow
    flow_rule(double dt) const override;

    std::string
    name_of_consistency() const;
    double
    strain_to_remould(double cell_size) const;
    double
    scale_of_softening() const;

    FlowLaw flow_law_;
    double  consistency_       = 100.;
    double  exponent_          = 1.;
    double  remoulded_ratio_   = 1.;
    double  strain_to_remould_ = default_strain;

    static constexpr double default_strain = 10.;
  };

} // namespace talus

#endif
