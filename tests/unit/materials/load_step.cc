// SPDX-License-Identifier: LGPL-2.1-or-later
#include "load_step_setup.h"

namespace
{
  template <int dim>
  void
  expect_consistent_tangents()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample) {
      LoadStep<dim> step(load_case, sample);
      EXPECT_LT(error_of_tangent(step), 1e-8);
    });
  }



  template <int dim>
  void
  expect_accepted_stress()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample) {
      LoadStep<dim> step(load_case, sample);
      const auto    F      = step.F();
      const auto    stress = step.linearization(step.H).stress;
      const double  before =
        step.law->has_strength() ? step.plastic_variable() : 0.;
      step.law->commit_load_step(step.points, step.workspace, 0, 1);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          EXPECT_NEAR(
            step.stress()[stress_index<dim>(std::min(i, j), std::max(i, j))],
            stress[dim * i + j],
            1e-13 * clay.bulk);

      if (step.law->has_strength())
        {
          EXPECT_EQ(step.plastic_variable() > before, load_case.flows);
          EXPECT_GE(step.plastic_variable(), before);
        }
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          EXPECT_EQ(step.F()[i][j], F[i][j]);
    });
  }



  /// The work of the step, by the trapezoidal rule, is elastic
  /// energy or plastic work.
  template <int dim>
  void
  expect_work()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample) {
      LoadStep<dim> step(load_case, sample);
      const auto    before = step.stress();
      step.law->commit_load_step(step.points, step.workspace, 0, 1);
      double work = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            const unsigned int c =
              stress_index<dim>(std::min(i, j), std::max(i, j));
            work += 0.5 * (before[c] + step.stress()[c]) * step.H[i][j];
          }
      EXPECT_NEAR(step.elastic_energy() + step.plastic_work(),
                  work * step.volume * determinant(step.F()),
                  1e-14 * clay.bulk);
      EXPECT_EQ(step.plastic_work() != 0., load_case.flows);
    });
  }



} // namespace



TEST(LoadStep, TangentIsTheDerivativeOfTheStress)
{
  expect_consistent_tangents<2>();
  expect_consistent_tangents<3>();
}



TEST(LoadStep, StressIsThatOfTheStateAfter)
{
  expect_accepted_stress<2>();
  expect_accepted_stress<3>();
}



TEST(LoadStep, WorkIsStoredOrDissipated)
{
  expect_work<2>();
  expect_work<3>();
}
