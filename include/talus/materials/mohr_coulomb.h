// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_mohr_coulomb_h
#define talus_materials_mohr_coulomb_h

#include <talus/materials/mohr_coulomb_kernel.h>
#include <talus/materials/rate_law.h>

#include <vector>

namespace talus
{
  /// Drained soil with friction and cohesion, in effective stress: elastic, and
  /// perfectly plastic by Mohr-Coulomb's criterion with a dilatancy angle, see
  /// MohrCoulombFlow. The strength factor multiplies c' and tan(phi').
  template <int dim>
  class MohrCoulomb : public RateLaw<dim, MohrCoulombFlow>
  {
  public:
    MohrCoulomb(const std::string &section);

    /// Throw ExcUser if an angle is out of its range, or plastic flow would
    /// create energy.
    void
    check() const override;

    double
    shear_strength(const Points<dim> &points, unsigned int p) const override;

    /// Return true: flow keeps the volume, or nearly.
    bool
    is_nearly_incompressible() const override
    {
      return true;
    }

    /// Return false: the direction of flow is not normal to the yield surface.
    bool
    has_symmetric_tangent() const override
    {
      return false;
    }

    void
    use_associated_flow(const bool is_associated) override
    {
      is_associated_ = is_associated;
    }

    Remark
    note(double cell_size) const override;

    Remark
    note_on_safety() const override;

  private:
    MohrCoulombFlow
    flow_rule(double dt) const override;

    double cohesion_ = 0., friction_angle_ = 30., dilatancy_angle_ = 0.;
    // A single number, or empty if the parameter is not given.
    std::vector<double> dilation_strain_;
    double              tension_       = 0.;
    bool                is_associated_ = false;
  };
} // namespace talus

#endif
