#ifndef talus_materials_herschel_bulkley_h
#define talus_materials_herschel_bulkley_h

#include <talus/materials/elasticity.h>
#include <talus/materials/material_model.h>

namespace talus
{
  /// Herschel-Bulkley: strength s_u + K gdot^n. Bingham: n = 1, and K is the
  /// viscosity.
  enum class FlowLaw
  {
    herschel_bulkley,
    bingham
  };



  /// "Herschel-Bulkley" and "Bingham": clay sheared without drainage that is
  /// the stronger the faster it is sheared, and loses strength as it is
  /// remoulded. Elastic as LinearElastic up to the shear stress
  /// tau = sqrt(s:s/2) = s_u; beyond, plastic at constant volume with
  /// tau = s_u(xi) + K gdot^n, where gdot = sqrt(2 Dp:Dp) is the plastic shear
  /// rate and xi its integral in time; in simple shear both are those of the
  /// engineering shear. Remoulding:
  /// s_u(xi) = f s_u0 [r + (1 - r) exp(-3 xi/xi_95)] @cite einav2005, with the
  /// strength factor f of the point, or 1.
  /// Backward Euler, see plastic_shear(). With K = 0 and r = 1 it is von Mises'
  /// law without hardening.
  template <int dim>
  class HerschelBulkley : public MaterialModel<dim>
  {
  public:
    HerschelBulkley(const std::string &section, FlowLaw flow_law);

    void
    check() const override;

    void
    add_columns(Points<dim> &points) override;

    /// With @p dt = 0 viscous material (K > 0) does not flow.
    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const override;

    bool
    linearize(const Points<dim>        &points,
              const StepWorkspace<dim> &workspace,
              unsigned int              begin,
              unsigned int              end,
              StrainMeasure             measure,
              StressTangent<dim>       *answer) const override;

    void
    accept(Points<dim>              &points,
           const StepWorkspace<dim> &workspace,
           unsigned int              begin,
           unsigned int              end,
           StrainMeasure             measure) const override;

    double
    shear_modulus() const override
    {
      return elasticity_.moduli().mu;
    }

    void
    wave_modulus(const Points<dim> &points,
                 unsigned int       begin,
                 unsigned int       end,
                 double            *modulus) const override;

    bool
    is_hyperelastic() const override
    {
      return false;
    }

    /// Plastic flow keeps the volume whatever Poisson's ratio is.
    bool
    locks() const override
    {
      return true;
    }

    bool
    has_strength() const override
    {
      return true;
    }

    double
    largest_strength_factor() const override;

    double
    shear_strength(const Points<dim> &points, unsigned int p) const override;

    std::string
    note(double cell_size) const override;

  private:
    auto
    slow_flow_rule(const Points<dim> &points) const;

    FlowLaw      flow_law_;
    Elasticity   elasticity_;
    double       strength_             = 2500.;
    double       consistency_          = 100.;
    double       exponent_             = 1.;
    double       remoulded_ratio_      = 1.;
    double       strain_to_remould_    = 10.;
    unsigned int plastic_shear_strain_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
