// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_hyperelastic_law_templates_h
#define talus_materials_hyperelastic_law_templates_h

#include <talus/base/assertion.h>
#include <talus/materials/hyperelastic_kernel.h>
#include <talus/materials/hyperelastic_law.h>
#include <talus/materials/inverted_point.h>
#include <talus/materials/load_step.h>

namespace talus
{
  template <int dim, typename StrainEnergy>
  void
  HyperelasticLaw<dim, StrainEnergy>::add_columns(Points<dim> &points)
  {
    deformation_ = points.add_column("deformation gradient",
                                     "-",
                                     ColumnKind::deformation,
                                     Inheritance::copied);
  }



  template <int dim, typename StrainEnergy>
  void
  HyperelasticLaw<dim, StrainEnergy>::initialize(Points<dim>       &points,
                                                 const unsigned int begin,
                                                 const unsigned int end) const
  {
    MaterialModel<dim>::initialize(points, begin, end);
    const auto columns = points.view();
    for (unsigned int p = begin; p < end; ++p)
      store_matrix(columns, deformation_, p, identity<dim, double>());
  }



  template <int dim, typename StrainEnergy>
  void
  HyperelasticLaw<dim, StrainEnergy>::update_stress(
    Points<dim>              &points,
    const StepWorkspace<dim> &workspace,
    const unsigned int        begin,
    const unsigned int        end,
    const double              dt) const
  {
    const StrainEnergy energy   = strain_energy();
    const auto         columns  = points.view();
    const auto         work     = workspace.view(begin, end);
    bool               is_sound = true;
    for_each_simd(begin,
                  end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    is_sound &= update_point_by_state<dim, decltype(number)>(
                      columns, work, deformation_, p, dt, energy);
                  });
    if (!is_sound)
      throw_inverted_point(
        points, begin, end, this->moduli().mu, this->submerged_density());
  }



  template <int dim, typename StrainEnergy>
  bool
  HyperelasticLaw<dim, StrainEnergy>::linearize(
    const Points<dim>        &points,
    const StepWorkspace<dim> &workspace,
    const unsigned int        begin,
    const unsigned int        end,
    const StrainMeasure       measure,
    StressTangent<dim>       *linearization) const
  {
    TalusAssert(measure == StrainMeasure::large, dealii::ExcInternalError());
    (void)measure;
    using Number              = Dual<dim * dim>;
    const auto         work   = workspace.view(begin, end);
    const StrainEnergy energy = strain_energy();
    for (unsigned int p = begin; p < end; ++p)
      {
        const auto H = load_independent_gradient(work, p);
        if (!(determinant_increment(H).value > -1.))
          return false;
        const auto before = load_matrix<dim, double>(points, deformation_, p);
        Matrix<dim, Number> F;
        for (unsigned int i = 0; i < dim; ++i)
          std::copy(before[i].begin(), before[i].end(), F[i].begin());
        F = product(identity_plus(H), F);

        StateResponse<dim, Number> after =
          energy.response(deformation_state(F));
        for (Number &component : after.kirchhoff)
          component *= 1. / determinant(before);
        store_nominal(after.kirchhoff,
                      H,
                      StrainMeasure::large,
                      linearization[p - begin]);
      }
    return true;
  }



  template <int dim, typename StrainEnergy>
  void
  HyperelasticLaw<dim, StrainEnergy>::commit_load_step(
    Points<dim>              &points,
    const StepWorkspace<dim> &workspace,
    const unsigned int        begin,
    const unsigned int        end,
    const StrainMeasure       measure) const
  {
    TalusAssert(measure == StrainMeasure::large, dealii::ExcInternalError());
    (void)measure;
    update_stress(points, workspace, begin, end, /*dt=*/1.);
  }



  template <int dim, typename StrainEnergy>
  void
  HyperelasticLaw<dim, StrainEnergy>::wave_modulus(const Points<dim> &points,
                                                   const unsigned int begin,
                                                   const unsigned int end,
                                                   double *modulus) const
  {
    const StrainEnergy energy  = strain_energy();
    const auto         columns = points.view();
    for_each_simd(
      begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number     = decltype(number);
        const auto state = deformation_state<dim, Number>(
          load_matrix<dim, Number>(columns, deformation_, p));
        const Number JM = energy.largest_modulus(state);
        store<Number>(modulus + (p - begin), JM / (1. + state.J_minus_1));
      });
  }
} // namespace talus

#endif
