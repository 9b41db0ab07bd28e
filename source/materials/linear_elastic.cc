#include <talus/materials/inverted_point.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/linear_elastic_kernel.h>
#include <talus/materials/load_step.h>

#include <algorithm>

namespace talus
{
  namespace
  {
    /// Elastic material does not flow.
    constexpr auto no_flow = [](const unsigned int, const auto &deviator) {
      using Number = std::decay_t<decltype(deviator[0])>;
      return Flow<Number>{Number{}, Number{}};
    };
  } // namespace



  template <int dim>
  LinearElastic<dim>::LinearElastic(const std::string &section)
    : MaterialModel<dim>(section)
  {
    elasticity_.declare(*this);
  }



  template <int dim>
  void
  LinearElastic<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
  }



  template <int dim>
  void
  LinearElastic<dim>::update_stress(Points<dim>              &points,
                                    const StepWorkspace<dim> &workspace,
                                    const unsigned int        begin,
                                    const unsigned int        end,
                                    const double              dt) const
  {
    const Moduli moduli  = elasticity_.moduli();
    const auto   columns = points.view();
    const auto   work    = workspace.view(begin, end);
    bool         sound   = true;
    for_each_simd(begin,
                  end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    sound &= update_linear_elastic_point<dim, decltype(number)>(
                      columns, work, p, dt, moduli);
                  });
    if (!sound)
      throw_inverted_point(points, begin, end);
  }



  template <int dim>
  bool
  LinearElastic<dim>::linearize(const Points<dim>        &points,
                                const StepWorkspace<dim> &workspace,
                                const unsigned int        begin,
                                const unsigned int        end,
                                const StrainMeasure       measure,
                                StressTangent<dim>       *answer) const
  {
    return linearize_rate_law(points,
                              workspace,
                              begin,
                              end,
                              measure,
                              elasticity_.moduli(),
                              answer,
                              no_flow);
  }



  template <int dim>
  void
  LinearElastic<dim>::accept(Points<dim>              &points,
                             const StepWorkspace<dim> &workspace,
                             const unsigned int        begin,
                             const unsigned int        end,
                             const StrainMeasure       measure) const
  {
    accept_rate_law(points,
                    workspace,
                    begin,
                    end,
                    measure,
                    elasticity_.moduli(),
                    dealii::numbers::invalid_unsigned_int,
                    no_flow);
  }



  template <int dim>
  void
  LinearElastic<dim>::wave_modulus(const Points<dim> & /*points*/,
                                   const unsigned int begin,
                                   const unsigned int end,
                                   double            *modulus) const
  {
    std::fill_n(modulus, end - begin, elasticity_.moduli().longitudinal());
  }



  template class LinearElastic<2>;
  template class LinearElastic<3>;
} // namespace talus
