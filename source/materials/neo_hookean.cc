#include <talus/materials/hyperelastic.h>
#include <talus/materials/load_step.h>
#include <talus/materials/neo_hookean.h>
#include <talus/materials/neo_hookean_kernel.h>

namespace talus
{
  template <int dim>
  NeoHookean<dim>::NeoHookean(const std::string &section)
    : MaterialModel<dim>(section)
  {
    elasticity_.declare(*this);
  }



  template <int dim>
  void
  NeoHookean<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
  }



  template <int dim>
  void
  NeoHookean<dim>::update_stress(Points<dim>              &points,
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
                      return neo_hookean(state, moduli);
                    });
  }



  template <int dim>
  bool
  NeoHookean<dim>::linearize(const Points<dim>        &points,
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
                                return neo_hookean(state, moduli);
                              });
  }



  template <int dim>
  void
  NeoHookean<dim>::accept(Points<dim>              &points,
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
  NeoHookean<dim>::wave_modulus(const Points<dim> &points,
                                const unsigned int begin,
                                const unsigned int end,
                                double            *modulus) const
  {
    wave_modulus_by_state(points,
                          begin,
                          end,
                          modulus,
                          [moduli = elasticity_.moduli()](const auto &state) {
                            return largest_acoustic_modulus(state, moduli);
                          });
  }



  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace talus
