#ifndef talus_materials_linear_elastic_h
#define talus_materials_linear_elastic_h

#include <talus/materials/elasticity.h>
#include <talus/materials/material_model.h>

namespace talus
{
  /// "linear elastic": Hooke's law between the Jaumann rate of the Cauchy
  /// stress and the rate of deformation. For small strains; in simple shear its
  /// stress is G sin(gamma), and only the volumetric part has an energy. See
  /// elastic_trial() for the integration.
  template <int dim>
  class LinearElastic : public MaterialModel<dim>
  {
  public:
    LinearElastic(const std::string &section);

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
      return false;
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
