#ifndef talus_materials_hyperelastic_h
#define talus_materials_hyperelastic_h

#include <talus/materials/hyperelastic_kernel.h>
#include <talus/materials/inverted_point.h>
#include <talus/points/step_workspace.h>

namespace talus
{
  /// Loop of all hyperelastic laws: @p response maps a DeformationState to a
  /// StateResponse.
  template <int dim, typename Response>
  inline void
  update_by_state(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  const unsigned int        begin,
                  const unsigned int        end,
                  const double              dt,
                  const Response           &response)
  {
    const auto columns = points.view();
    const auto work    = workspace.view(begin, end);
    bool       sound   = true;
    for_each_simd(begin,
                  end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    sound &= update_point_by_state<dim, decltype(number)>(
                      columns, work, p, dt, response);
                  });
    if (!sound)
      throw_inverted_point(points, begin, end);
  }



  /// MaterialModel::wave_modulus() of all hyperelastic laws: @p modulus maps a
  /// DeformationState to J M, M the largest eigenvalue of the acoustic tensor
  /// over all directions.
  template <int dim, typename Modulus>
  inline void
  wave_modulus_by_state(const Points<dim> &points,
                        const unsigned int begin,
                        const unsigned int end,
                        double            *to,
                        const Modulus     &modulus)
  {
    const auto columns = points.view();
    for_each_simd(
      begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number     = decltype(number);
        const auto state = deformation_state<dim, Number>(
          load_matrix<dim, Number>(columns, columns.deformation_gradient, p));
        const Number JM = modulus(state);
        store<Number>(to + (p - begin), JM / (1. + state.J_minus_1));
      });
  }
} // namespace talus

#endif
