#ifndef talus_materials_von_mises_h
#define talus_materials_von_mises_h

#include <talus/materials/elasticity.h>
#include <talus/materials/material_model.h>

namespace talus
{
  /// "von Mises": clay sheared without drainage. Elastic as LinearElastic up to
  /// the equivalent stress q = sqrt(3/2 s:s) = sigma_y, then plastic at
  /// constant volume; in simple shear the yield stress is the undrained shear
  /// strength, sigma_y = sqrt(3) s_u. Linear in the equivalent plastic strain:
  /// sigma_y = f max(sqrt(3) s_u + H ep, sqrt(3) s_residual), returned exactly
  /// @cite simo1998, section 3.3; f is the strength factor of the point, or 1.
  template <int dim>
  class VonMises : public MaterialModel<dim>
  {
  public:
    VonMises(const std::string &section);

    void
    check() const override;

    void
    add_columns(Points<dim> &points) override;

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
    flow_rule(const Points<dim> &points) const;

    Elasticity   elasticity_;
    double       strength_          = 2500.;
    double       hardening_         = 0.;
    double       residual_strength_ = 0.;
    unsigned int plastic_strain_    = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
