// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_modified_cam_clay_h
#define talus_materials_modified_cam_clay_h

#include <talus/materials/cam_clay_kernel.h>
#include <talus/materials/rate_law.h>

#include <string>
#include <vector>

namespace talus
{
  /// Clay with a critical state, in effective stress: stiffness and strength
  /// follow from the stress at the start and its history, the preconsolidation
  /// pressure. See CamClayFlow. The strength factor multiplies tan(phi).
  template <int dim>
  class ModifiedCamClay : public RateLaw<dim, CamClayFlow>
  {
  public:
    ModifiedCamClay(const std::string &section);

    /// Throw ExcUser if the lines of compression and swelling contradict each
    /// other, or the soil has no friction.
    void
    check() const override;

    void
    add_columns(Points<dim> &points) override;

    /// Set the preconsolidation pressure of soil that nothing has compressed.
    void
    initialize(Points<dim> &points,
               unsigned int begin,
               unsigned int end) const override;

    const std::string *
    overconsolidation_ratio() const override
    {
      return &ratio_;
    }

    /// The preconsolidation pressure is that of level ground under the largest
    /// vertical stress, and at least that of the stress of the point.
    double
    consolidate(Points<dim> &points,
                unsigned int p,
                double       vertical_stress,
                double       ratio) const override;

    void
    use_initial_pressure(const double largest) override
    {
      largest_pressure_ = largest + attraction_;
    }

    void
    list_state(StateList &list) override;

    /// Shear stress at the critical state; in undrained soil at that of the
    /// volume the soil has.
    double
    shear_strength(const Points<dim> &points, unsigned int p) const override;

    double
    largest_shear_modulus(const Points<dim> &points,
                          unsigned int       begin,
                          unsigned int       end) const override;

    void
    wave_modulus(const Points<dim> &points,
                 unsigned int       begin,
                 unsigned int       end,
                 double            *modulus) const override;

    /// Return true: at the critical state flow keeps the volume.
    bool
    is_nearly_incompressible() const override
    {
      return true;
    }

    /// Return false: the deviator returns along itself for any Lode angle.
    bool
    has_symmetric_tangent() const override
    {
      return false;
    }

  private:
    CamClayFlow
    flow_rule(double dt) const override;

    /// Young's modulus over pressure [-].
    double
    young_modulus() const override;

    double
    bulk_modulus_for_water() const override
    {
      return largest_pressure_ * (1. + void_ratio_) / swelling_;
    }

    /// Pressure of point @p p that stiffen() finds, Pa.
    double
    pressure(const Points<dim> &points, unsigned int p) const;

    /// Mean effective stress at the critical state at the volume of soil with
    /// @p pressure and @p preconsolidation, Pa.
    double
    critical_pressure(double pressure, double preconsolidation) const;

    double      friction_angle_ = 25., compression_ = 0.2, swelling_ = 0.04;
    double      void_ratio_ = 1., attraction_ = 100.;
    std::string ratio_ = "1";
    // A single number, or empty if the parameter is not given.
    std::vector<double> K0_;
    double              largest_pressure_ = 1.;
    unsigned int strength_column_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
