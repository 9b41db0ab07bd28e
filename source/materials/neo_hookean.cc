#include <talus/materials/hyperelastic.h>
#include <talus/materials/load_step.h>
#include <talus/materials/neo_hookean.h>

namespace talus
{
  namespace
  {
    template <int dim, typename Number>
    inline StateResponse<dim, Number>
    neo_hookean(const DeformationState<dim, Number> &state,
                const Moduli                        &moduli)
    {
      const Number pressure = moduli.lambda * state.log_J;

      StateResponse<dim, Number> answer;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        answer.kirchhoff[c] = moduli.mu * state.b_minus_1[c];
      answer.kirchhoff = add_mean(answer.kirchhoff, pressure);

      // tr b - 3 = 2 tr A + A:A, which leaves nothing to cancel but tr A - ln J
      Number square{};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          square += state.A[i][j] * state.A[i][j];
      answer.energy =
        moduli.mu * (trace(state.A) - state.log_J + 0.5 * square) +
        0.5 * pressure * state.log_J;
      return answer;
    }



    /// J times the largest eigenvalue of the acoustic tensor. In direction n it
    /// is [(lambda (1 - ln J) + mu) n n + mu (n.b.n) I]/J, so the longitudinal
    /// wave along the largest stretch is the fastest; far in tension the first
    /// factor turns negative and the shear wave is. Exact in 2-D, from above in
    /// 3-D (EigenvalueRange).
    template <int dim, typename Number>
    inline Number
    largest_acoustic_modulus(const DeformationState<dim, Number> &state,
                             const Moduli                        &moduli)
    {
      const EigenvalueRange<dim, Number> b(state.b_minus_1);
      const Number                       longitudinal =
        moduli.lambda * (1. - state.log_J) + moduli.mu;
      return max(longitudinal, Number{}) +
             moduli.mu * (1. + b.mean + b.distance);
    }
  } // namespace



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
  NeoHookean<dim>::update_stress(Points<dim>       &points,
                                 const unsigned int begin,
                                 const unsigned int end,
                                 const double       dt) const
  {
    update_by_state(points,
                    begin,
                    end,
                    dt,
                    [moduli = elasticity_.moduli()](const auto &state) {
                      return neo_hookean(state, moduli);
                    });
  }



  template <int dim>
  bool
  NeoHookean<dim>::linearize(const Points<dim>  &points,
                             const unsigned int  begin,
                             const unsigned int  end,
                             const StrainMeasure measure,
                             StressTangent<dim> *answer) const
  {
    Assert(measure == StrainMeasure::large, dealii::ExcInternalError());
    (void)measure;
    return linearize_by_state(points,
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
  NeoHookean<dim>::accept(Points<dim>        &points,
                          const unsigned int  begin,
                          const unsigned int  end,
                          const StrainMeasure measure) const
  {
    Assert(measure == StrainMeasure::large, dealii::ExcInternalError());
    (void)measure;
    update_stress(points, begin, end, /*dt=*/1.);
  }



  template <int dim>
  void
  NeoHookean<dim>::wave_speed(const Points<dim> &points,
                              const unsigned int begin,
                              const unsigned int end,
                              double            *speed) const
  {
    wave_speed_by_state(points,
                        begin,
                        end,
                        speed,
                        [moduli = elasticity_.moduli()](const auto &state) {
                          return largest_acoustic_modulus(state, moduli);
                        });
  }



  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace talus
