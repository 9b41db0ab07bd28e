// SPDX-License-Identifier: LGPL-2.1-or-later
// Hyperelastic laws at one point.

#include "specimen.h"

using namespace talus;

namespace
{
  const Elastic rubber{1e4, 0.3};

  const std::vector<std::string> laws = {"Hencky", "neo-Hookean"};



  /// A deformation gradient with determinant around one.
  template <int dim>
  Matrix<dim, double>
  random_F(std::mt19937 &random)
  {
    const auto stretch =
      add(identity<dim, double>(), random_matrix<dim>(random, 0.3), 1.);
    return product(rotation<dim>(6. * random() / 4294967295.), stretch);
  }



  // sigma = dW/dF F^T / J by central differences.
  template <int dim>
  void
  check_stress_is_derivative(const std::string &name)
  {
    std::mt19937  random(3);
    Specimen<dim> soil(name, rubber.parameters());
    for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const auto          F   = random_F<dim>(random);
        const double        eps = 1e-5;
        Matrix<dim, double> P;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              auto F_plus = F, F_minus = F;
              F_plus[i][j] += eps;
              F_minus[i][j] -= eps;
              P[i][j] =
                (soil.energy_at(F_plus) - soil.energy_at(F_minus)) / (2. * eps);
            }
        const auto tau = product(P, transpose(F));
        soil.energy_at(F);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            EXPECT_NEAR(soil.stress()[stress_index<dim>(i, j)],
                        tau[i][j] / determinant(F),
                        1e-8 * rubber.E)
              << name << ' ' << i << ' ' << j;
      }
  }



  template <int dim>
  void
  check_rotation_invariance(const std::string &name)
  {
    std::mt19937  random(4);
    Specimen<dim> soil(name, rubber.parameters());
    for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const auto   F     = random_F<dim>(random);
        const auto   R     = rotation<dim>(0.3 * sample);
        const double W     = soil.energy_at(F);
        const auto   sigma = soil.stress();
        EXPECT_NEAR(soil.energy_at(product(R, F)), W, 1e-13 * rubber.E);
        expect_near(soil.stress(), rotated(R, sigma), 1e-13 * rubber.E);
        // Isotropic: a rotation before the deformation goes unseen.
        EXPECT_NEAR(soil.energy_at(product(F, R)), W, 1e-13 * rubber.E);
        expect_near(soil.stress(), sigma, 1e-13 * rubber.E);
      }
  }



  void
  check_plane_strain(const std::string &name)
  {
    std::mt19937 random(5);
    Specimen<2>  plane(name, rubber.parameters());
    Specimen<3>  space(name, rubber.parameters());
    for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const auto F  = random_F<2>(random);
        auto       F3 = identity<3, double>();
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            F3[i][j] = F[i][j];
        EXPECT_NEAR(plane.energy_at(F), space.energy_at(F3), 1e-13 * rubber.E);
        const auto sigma = space.stress();
        expect_near(plane.stress(),
                    {{sigma[0], sigma[1], sigma[2], sigma[3]}},
                    1e-13 * rubber.E);
        EXPECT_NEAR(sigma[4], 0., 1e-13 * rubber.E);
        EXPECT_NEAR(sigma[5], 0., 1e-13 * rubber.E);
      }
  }



  /// Unit vectors on a half circle or half sphere.
  template <int dim>
  std::vector<std::array<double, dim>>
  directions()
  {
    std::vector<std::array<double, dim>> all;
    const unsigned int                   n = dim == 2 ? 180 : 16;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double a = pi * i / n;
        if constexpr (dim == 2)
          all.push_back({{std::cos(a), std::sin(a)}});
        else
          for (unsigned int j = 0; j <= n; ++j)
            {
              const double z = 2. * j / n - 1., r = std::sqrt(1. - z * z);
              all.push_back({{r * std::cos(a), r * std::sin(a), z}});
            }
      }
    return all;
  }



  // In direction n with polarisation a, J rho c^2 is the second derivative of
  // W(F + e a (F^T n)) by e.
  template <int dim>
  double
  fastest_wave(Specimen<dim> &soil, const Matrix<dim, double> &F)
  {
    const double W       = soil.energy_at(F);
    double       largest = 0.;
    for (const auto &n : directions<dim>())
      for (const auto &a : directions<dim>())
        {
          Matrix<dim, double> dF{};
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              for (unsigned int k = 0; k < dim; ++k)
                dF[i][j] += a[i] * F[k][j] * n[k];
          const double e = 1e-3;
          largest        = std::max(largest,
                             (soil.energy_at(add(F, dF, e)) +
                              soil.energy_at(add(F, dF, -e)) - 2. * W) /
                               (e * e));
        }
    // rho = density / J
    return std::sqrt(largest / soil.law->density());
  }



  // Never below the fastest wave, and not more than @p excess above.
  template <int dim>
  void
  check_wave_speed(const std::string &name,
                   const double       excess,
                   const unsigned int n_samples)
  {
    std::mt19937  random(6);
    Specimen<dim> soil(name, rubber.parameters());
    for (unsigned int sample = 0; sample < n_samples; ++sample)
      {
        const auto   F    = random_F<dim>(random);
        const double wave = fastest_wave(soil, F);
        soil.set_F(F);
        EXPECT_GE(soil.wave_speed(), wave * (1. - 1e-5)) << name;
        EXPECT_LE(soil.wave_speed(), wave * (1. + excess)) << name;
      }
  }
} // namespace



TEST(Hyperelastic, StressIsTheDerivativeOfTheEnergy)
{
  for (const std::string &name : laws)
    {
      check_stress_is_derivative<2>(name);
      check_stress_is_derivative<3>(name);
    }
}



TEST(Hyperelastic, RotationsGoUnseen)
{
  for (const std::string &name : laws)
    {
      check_rotation_invariance<2>(name);
      check_rotation_invariance<3>(name);
    }
}



TEST(Hyperelastic, PlaneStrainInTwoAndThreeDimensions)
{
  for (const std::string &name : laws)
    check_plane_strain(name);
}



TEST(Hyperelastic, NeoHookeanClosedForm)
{
  const double L = 1.7;
  Specimen<2>  soil("neo-Hookean", rubber.parameters());
  soil.energy_at({{{{{L, 0.}}, {{0., 1.}}}}});
  const double p = rubber.lambda * std::log(L);
  expect_near(soil.stress(),
              {{(p + rubber.mu * (L * L - 1.)) / L, p / L, p / L, 0.}},
              1e-12 * rubber.E);
}



// Equal, nearly equal and very different stretches.
TEST(Hyperelastic, HenckyPrincipalStretches)
{
  Specimen<2> plane("Hencky", rubber.parameters());
  Specimen<3> space("Hencky", rubber.parameters());
  for (const auto [a, b] : {std::array<double, 2>{{1., 1.}},
                            {{1.3, 1.3}},
                            {{1.3, 1.3 + 1e-12}},
                            {{1. + 1e-9, 1.}},
                            {{0.5, 1.7}},
                            {{100., 0.01}}})
    {
      const double ln_J = std::log(a) + std::log(b), J = a * b;
      const double p   = rubber.lambda * ln_J;
      const double xx  = (p + 2. * rubber.mu * std::log(a)) / J;
      const double yy  = (p + 2. * rubber.mu * std::log(b)) / J;
      const double tol = (a == 100. ? 1e-8 : 1e-14) * rubber.E;
      plane.energy_at({{{{{a, 0.}}, {{0., b}}}}});
      expect_near(plane.stress(), {{xx, yy, p / J, 0.}}, tol);
      space.energy_at({{{{{a, 0., 0.}}, {{0., 1., 0.}}, {{0., 0., b}}}}});
      expect_near(space.stress(), {{xx, p / J, yy, 0., 0., 0.}}, tol);
      // The same with principal axes askew, V = R diag R^T.
      const auto R     = rotation<3>(1.1);
      const auto sigma = rotated(R, space.stress());
      space.energy_at(product(product(R, space.F()), transpose(R)));
      expect_near(space.stress(), sigma, 10. * tol);
    }
}



TEST(WaveSpeed, IsThatOfTheUndeformedMaterial)
{
  const double c = std::sqrt((rubber.lambda + 2. * rubber.mu) / 600.);
  for (const std::string &name : material_names<2>())
    {
      EXPECT_NEAR(Specimen<2>(name, rubber.parameters_of(name)).wave_speed(),
                  c,
                  1e-13 * c);
      EXPECT_NEAR(Specimen<3>(name, rubber.parameters_of(name)).wave_speed(),
                  c,
                  1e-13 * c);
    }
}



// Rate laws: same stiffness, current density.
TEST(WaveSpeed, RateLawsSeeTheDensity)
{
  const double c = std::sqrt((rubber.lambda + 2. * rubber.mu) / 600.);
  for (const std::string name : {"linear elastic", "von Mises"})
    {
      Specimen<2> soil(name, rubber.parameters());
      soil.set_F({{{{{0.8, 0.3}}, {{0., 0.8}}}}});
      EXPECT_NEAR(soil.wave_speed(), 0.8 * c, 1e-13 * c);
    }
}



TEST(WaveSpeed, HyperelasticLawsBoundTheFastestWave)
{
  check_wave_speed<2>("neo-Hookean", 1e-3, 10);
  check_wave_speed<3>("neo-Hookean", 0.1, 2);
  check_wave_speed<2>("Hencky", 0.3, 10);
  check_wave_speed<3>("Hencky", 0.3, 2);
}
