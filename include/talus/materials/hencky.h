#ifndef talus_materials_hencky_h
#define talus_materials_hencky_h

#include <talus/materials/elasticity.h>
#include <talus/materials/material_model.h>

namespace talus
{
  /// "Hencky": hyperelastic, quadratic in the logarithmic strain ln V:
  /// W = K/2 (ln J)^2 + mu dev(ln V) : dev(ln V) per undeformed volume,
  /// Kirchhoff stress tau = K ln J I + 2 mu dev(ln V) @cite simo1998, chapter
  /// 9. In 2-D the strain out of the plane is zero.
  template <int dim>
  class Hencky : public MaterialModel<dim>
  {
  public:
    Hencky(const std::string &section);

    void
    check() const override;

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
      return true;
    }

    bool
    locks() const override
    {
      return elasticity_.nearly_incompressible();
    }

  private:
    Elasticity elasticity_;
  };
} // namespace talus

#endif
