// SPDX-License-Identifier: LGPL-2.1-or-later
#include "load_step_setup.h"

namespace
{
  template <int dim>
  void
  expect_consistent_tangents()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample, auto measure) {
      LoadStep<dim> step(load_case, sample);
      EXPECT_LT(error_of_tangent(step, measure), 1e-8);
    });
  }



  /// sigma of the point as it is now, seen from before the step @p H.
  template <int dim>
  std::array<double, dim * dim>
  nominal_stress(const LoadStep<dim> &step, const StrainMeasure measure)
  {
    const auto sigma = step.stress();
    auto       f     = identity<dim, double>();
    if (measure == StrainMeasure::large)
      f = add(f, step.H, 1.);
    const auto                    back = inverse(f);
    std::array<double, dim * dim> P{};
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          P[dim * i + j] +=
            determinant(f) *
            sigma[stress_index<dim>(std::min(i, k), std::max(i, k))] *
            back[j][k];
    return P;
  }



  template <int dim>
  void
  expect_accepted_stress()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample, auto measure) {
      LoadStep<dim> step(load_case, sample);
      const auto    F      = step.F();
      const auto    stress = step.linearization(step.H, measure).stress;
      const double  before =
        step.law->has_strength() ? step.plastic_variable() : 0.;
      step.law->commit_load_step(step.points, step.workspace, 0, 1, measure);
      expect_near(nominal_stress(step, measure), stress, 1e-13 * clay.bulk);

      if (step.law->has_strength())
        {
          EXPECT_EQ(step.plastic_variable() > before, load_case.flows);
          EXPECT_GE(step.plastic_variable(), before);
        }
      const auto after =
        measure == StrainMeasure::large
          ? product(add(identity<dim, double>(), step.H, 1.), F)
          : F;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          EXPECT_NEAR(step.F()[i][j],
                      after[i][j],
                      measure == StrainMeasure::small ? 0. : 1e-15);
    });
  }



  /// Small strain: the work of the step, by the trapezoidal rule, is elastic
  /// energy or plastic work.
  template <int dim>
  void
  expect_work()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample, auto measure) {
      if (measure == StrainMeasure::large)
        return;
      LoadStep<dim> step(load_case, sample);
      const auto    before = step.stress();
      step.law->commit_load_step(step.points, step.workspace, 0, 1, measure);
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



  /// With large strain a load step is a step of the dynamics: the columns are
  /// those of update_stress().
  template <int dim>
  void
  expect_step_of_dynamics()
  {
    for_load_steps<dim>([](LoadCase load_case, auto sample, auto measure) {
      const bool is_viscous =
        load_case.law == "Bingham" || load_case.law == "Herschel-Bulkley";
      if (measure == StrainMeasure::small || is_viscous)
        return;
      LoadStep<dim> accepted(load_case, sample), updated(load_case, sample);
      accepted.law->commit_load_step(
        accepted.points, accepted.workspace, 0, 1, measure);
      updated.law->update_stress(updated.points, updated.workspace, 0, 1, 1.);
      for (const Column &column : updated.points.columns())
        for (unsigned int c = 0; c < column.n_components; ++c)
          {
            const double expected = updated.points.data(column.first, c)[0];
            const double scale    = column.unit == "Pa"  ? clay.mu
                                    : column.unit == "J" ? 0.1 * clay.mu
                                                         : 1.;
            EXPECT_NEAR(accepted.points.data(column.first, c)[0],
                        expected,
                        1e-13 * (std::abs(expected) + 0.1 * scale))
              << column.name;
          }
    });
  }



  /// Without viscosity and remoulding the slow limit is the dynamics, too.
  template <int dim>
  void
  expect_inviscid_dynamics(const LoadCase &load_case)
  {
    for (unsigned int sample = 1; sample <= n_samples; ++sample)
      {
        LoadStep<dim> accepted(load_case, sample), updated(load_case, sample);
        accepted.law->commit_load_step(
          accepted.points, accepted.workspace, 0, 1, StrainMeasure::large);
        updated.law->update_stress(updated.points, updated.workspace, 0, 1, 1.);
        expect_near(accepted.stress(), updated.stress(), 1e-13 * clay.mu);
        EXPECT_NEAR(accepted.plastic_variable(),
                    updated.plastic_variable(),
                    1e-14);
        EXPECT_GT(updated.plastic_variable(), 0.3);
      }
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



TEST(LoadStep, LargeStrainIsTheDynamics)
{
  expect_step_of_dynamics<2>();
  expect_step_of_dynamics<3>();
}



TEST(LoadStep, InviscidSlowFlowIsTheDynamics)
{
  for (const std::string law : {"Bingham", "Herschel-Bulkley"})
    for (const double factor : {0., 0.6})
      {
        const LoadCase inviscid{law,
                                law,
                                "set Undrained shear strength = 2500\nset " +
                                  std::string(law == "Bingham"
                                                ? "Viscosity"
                                                : "Consistency") +
                                  " = 0\n",
                                true,
                                0.3,
                                factor};
        expect_inviscid_dynamics<2>(inviscid);
        expect_inviscid_dynamics<3>(inviscid);
      }
}
