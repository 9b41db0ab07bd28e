#include <talus/materials/hencky.h>
#include <talus/materials/hencky_kernel.h>
#include <talus/materials/hyperelastic.h>
#include <talus/materials/load_step.h>

namespace talus
{
  template <int dim>
  Hencky<dim>::Hencky(const std::string &section)
    : MaterialModel<dim>(section)
  {
    elasticity_.declare(*this);
  }



  template <int dim>
  void
  Hencky<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
  }



  template <int dim>
  void
  Hencky<dim>::update_stress(Points<dim>              &points,
                             const StepWorkspace<dim> &workspace,
                             const unsigned int        begin,
                             const unsigned int        end,
                             const double              dt) const
  {
    update_by_state(points,
                    workspace,
                    begin,
                    end,
                    dt,
                    [moduli = elasticity_.moduli()](const auto &state) {
                      return hencky(state, moduli);
                    });
  }



  template <int dim>
  bool
  Hencky<dim>::linearize(const Points<dim>        &points,
                         const StepWorkspace<dim> &workspace,
                         const unsigned int        begin,
                         const unsigned int        end,
                         const StrainMeasure       measure,
                         StressTangent<dim>       *answer) const
  {
    Assert(measure == StrainMeasure::large, dealii::ExcInternalError());
    (void)measure;
    return linearize_by_state(points,
                              workspace,
                              begin,
                              end,
                              answer,
                              [moduli =
                                 elasticity_.moduli()](const auto &state) {
                                return hencky(state, moduli);
                              });
  }



  template <int dim>
  void
  Hencky<dim>::accept(Points<dim>              &points,
                      const StepWorkspace<dim> &workspace,
                      const unsigned int        begin,
                      const unsigned int        end,
                      const StrainMeasure       measure) const
  {
    Assert(measure == StrainMeasure::large, dealii::ExcInternalError());
    (void)measure;
    update_stress(points, workspace, begin, end, /*dt=*/1.);
  }



  template <int dim>
  void
  Hencky<dim>::wave_modulus(const Points<dim> &points,
                            const unsigned int begin,
                            const unsigned int end,
                            double            *modulus) const
  {
    wave_modulus_by_state(points,
                          begin,
                          end,
                          modulus,
                          [moduli = elasticity_.moduli()](const auto &state) {
                            return largest_modulus(state, moduli);
                          });
  }



  template class Hencky<2>;
  template class Hencky<3>;
} // namespace talus
