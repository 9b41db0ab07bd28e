// SPDX-License-Identifier: LGPL-2.1-or-later
// Symmetry, strength and special states of the laws' load steps.

#include "load_step_setup.h"

namespace
{
  template <int dim>
  double
  asymmetry(const StressTangent<dim> &linearization)
  {
    double result = 0.;
    for (unsigned int k = 0; k < dim * dim; ++k)
      for (unsigned int l = 0; l < k; ++l)
        result = std::max(result,
                          std::abs(linearization.tangent[k][l] -
                                   linearization.tangent[l][k]));
    return result / clay.mu;
  }



  template <int dim>
  void
  expect_symmetry()
  {
    for_load_steps<dim>([&](const auto &load_case, auto sample) {
      LoadStep<dim> step(load_case, sample);
      const auto    linearization = step.linearization(step.H);
      EXPECT_LT(asymmetry(linearization), 1e-13);
      // Small strain does not see rotations.
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < i; ++j)
          for (unsigned int k = 0; k < dim * dim; ++k)
            EXPECT_EQ(linearization.tangent[k][dim * i + j],
                      linearization.tangent[k][dim * j + i]);
    });
  }



  /// lambda delta_ij delta_kl + mu (delta_ik delta_jl + delta_il delta_jk)
  template <int dim>
  void
  expect_hooke(const StressTangent<dim> &linearization)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            EXPECT_NEAR(linearization.tangent[dim * i + j][dim * k + l],
                        clay.lambda * (i == j) * (k == l) +
                          clay.mu * ((i == k) * (j == l) + (i == l) * (j == k)),
                        1e-13 * clay.bulk);
  }



  /// At no stress and no deformation every law is Hooke's.
  template <int dim>
  void
  expect_hooke_at_rest()
  {
    for (const LoadCase &load_case : load_cases())
      {
        SCOPED_TRACE(load_case.name);
        LoadStep<dim> step(load_case, 1);
        step.set_F(identity<dim, double>());
        for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
          step.points.data(step.points.stress, c)[0] = 0.;
        const auto linearization = step.linearization(Matrix<dim, double>{});
        for (const double stress : linearization.stress)
          EXPECT_EQ(stress, 0.);
        expect_hooke(linearization);
        EXPECT_NEAR(step.law->largest_shear_modulus(step.points, 0, 1),
                    clay.mu,
                    1e-14 * clay.mu);
      }
  }



  /// sqrt(s:s/2) after the step is the strength: for von Mises that of the
  /// state after, for slow flow that of the state before.
  template <int dim>
  void
  expect_strength()
  {
    for_load_steps<dim>([](const auto &load_case, auto sample) {
      if (!load_case.flows)
        return;
      LoadStep<dim> step(load_case, sample);
      const double  xi = step.plastic_variable();
      const double  factor =
        load_case.strength_factor > 0. ? load_case.strength_factor : 1.;
      step.law->commit_load_step(step.points, step.workspace, 0, 1);
      const double tau = std::sqrt(0.5 * step.deviator_squared());
      const double strength =
        load_case.law == "von Mises"
          ? step.law->shear_strength(step.points, 0)
          : factor * s_u * (0.3 + 0.7 * std::exp(-3. * xi / 2.));
      EXPECT_NEAR(tau, strength, 1e-12 * s_u);
    });
  }



} // namespace



TEST(LoadStep, TangentsAreSymmetric)
{
  expect_symmetry<2>();
  expect_symmetry<3>();
}



TEST(LoadStep, HookesLawAtRest)
{
  expect_hooke_at_rest<2>();
  expect_hooke_at_rest<3>();
}



TEST(LoadStep, EndsAtTheStrength)
{
  expect_strength<2>();
  expect_strength<3>();
}



// In the plane with the third direction unstretched: the 2-D law.
TEST(LoadStep, PlaneStrainIsThatOfSpace)
{
  for (const LoadCase &load_case : load_cases())
    {
      SCOPED_TRACE(load_case.name);
      LoadStep<2> plane(load_case, 3);
      LoadStep<3> space(load_case, 3);
      auto        F = identity<3, double>();
      space.H       = {};
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          {
            F[i][j]       = plane.F()[i][j];
            space.H[i][j] = plane.H[i][j];
          }
      space.set_F(F);
      for (unsigned int c = 0; c < 6; ++c)
        space.points.data(space.points.stress, c)[0] =
          c < 4 ? plane.stress()[c] : 0.;
      const auto a = plane.linearization(plane.H);
      const auto b = space.linearization(space.H);
      for (unsigned int k = 0; k < 4; ++k)
        {
          const unsigned int K = 3 * (k / 2) + k % 2;
          EXPECT_NEAR(a.stress[k], b.stress[K], 1e-13 * clay.bulk);
          for (unsigned int l = 0; l < 4; ++l)
            EXPECT_NEAR(a.tangent[k][l],
                        b.tangent[K][3 * (l / 2) + l % 2],
                        1e-12 * clay.bulk);
        }
    }
}
