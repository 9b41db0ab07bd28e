// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_von_mises_h
#define talus_materials_von_mises_h

#include <talus/materials/undrained_law.h>

namespace talus
{
  struct VonMisesFlow;

  /// "von Mises": clay sheared without drainage. Elastic as LinearElastic up to
  /// the equivalent stress q = sqrt(3/2 s:s) = sigma_y, then plastic at
  /// constant volume; in simple shear the yield stress corresponds to the
  /// undrained shear strength, sigma_y = sqrt(3) s_u. Linear in the equivalent
  /// plastic strain ep,
  ///   sigma_y = f max(sqrt(3) s_u + H ep, sqrt(3) s_residual),
  /// returned exactly @cite simo1998, section 3.3; f is the strength factor of
  /// the point, or 1. With a softening displacement d, linear in the
  /// displacement across a band as wide as the cell, h sqrt(3) dep in a step.
  template <int dim>
  class VonMises : public UndrainedLaw<dim, VonMisesFlow>
  {
  public:
    VonMises(const std::string &section);

    void
    check() const override;

    void
    check_strength(const StrengthRange &range) const override;

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
    shear_per_plastic_variable() const override;

    std::string
    slower_softening(double times) const override;

    VonMisesFlow
    flow_rule(double dt) const override;

    double hardening_         = 0.;
    double residual_strength_ = 0.;
  };
} // namespace talus

#endif
