// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_hyperelastic_law_templates_h
#define talus_materials_hyperelastic_law_templates_h

#include <talus/materials/hyperelastic_kernel.h>
#include <talus/materials/hyperelastic_law.h>
#include <talus/materials/inverted_point.h>

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
  void
  HyperelasticLaw<dim, StrainEnergy>::wave_modulus(const Points<dim> &points,
                                                   const unsigned int begin,
                                                   const unsigned int end,
                                                   double *modulus) const
  {
    const StrainEnergy energy  = strain_energy();
    const double       water   = this->pore_water().stiffness;
    const auto         columns = points.view();
    for_each_simd(begin,
                  end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    using Number     = decltype(number);
                    const auto state = deformation_state<dim, Number>(
                      load_matrix<dim, Number>(columns, deformation_, p));
                    const Number JM = energy.largest_modulus(state);
                    store<Number>(modulus + (p - begin),
                                  JM / (1. + state.J_minus_1) + water);
                  });
  }
} // namespace talus

#endif
