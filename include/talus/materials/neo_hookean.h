#ifndef talus_materials_neo_hookean_h
#define talus_materials_neo_hookean_h

#include <talus/materials/elasticity.h>
#include <talus/materials/material_model.h>

namespace talus
{
  /// "neo-Hookean": hyperelastic, sigma = [lambda ln J I + mu (F F^T - I)]/J,
  /// W = mu/2 (tr(F F^T) - 3 - 2 ln J) + lambda/2 (ln J)^2 per undeformed
  /// volume @cite bonet2008, section 6.4. In 2-D the strain out of the plane is
  /// zero.
  template <int dim>
  class NeoHookean : public MaterialModel<dim>
  {
  public:
    NeoHookean(const std::string &section);

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
