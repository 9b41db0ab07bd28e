// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/materials/rate_law.templates.h>

#include "specimen.h"

// A flow rule that changes the mean stress, by a law of the test.

namespace return_mapping_test
{
  using namespace talus;

  const Elastic    sand{250e3, 0.3};
  constexpr double friction = 0.4, dilation = 0.1, cohesion = 500.; // -, -, Pa

  /// Cone of Drucker and Prager, tau <= cohesion - friction * mean stress, away
  /// from the apex. The plastic variable is the plastic shear strain.
  struct ConeFlow
  {
    template <int dim, typename Number, typename Strength>
    Flow<Number, Number>
    operator()(const StressStep<dim, Number> &trial,
               const Strength & /*softening*/,
               const PointStrength<Strength> &point) const
    {
      const auto  &s   = trial.deviator_after;
      const Number tau = sqrt(0.5 * contract(s, s) + 1e-300);
      const Number strength =
        (cohesion - friction * trial.mean_after) * point.factor;
      const Number shear =
        max(Number((tau - strength) *
                   (1. / (sand.mu + sand.bulk * friction * dilation))),
            Number(0.));
      return {sand.mu * shear / tau, shear, dilation * shear};
    }
  };



  template <int dim>
  struct Cone : RateLaw<dim, ConeFlow>
  {
    explicit Cone(const std::string &section)
      : RateLaw<dim, ConeFlow>(section, "plastic shear strain")
    {}

    ConeFlow
    flow_rule(double) const override
    {
      return {};
    }
  };



  /// A point under pressure, and a step of shear and some compression.
  template <int dim>
  struct ConeStep : Specimen<dim>
  {
    using Specimen<dim>::law;
    using Specimen<dim>::points;
    using Specimen<dim>::workspace;

    ConeStep()
      : Specimen<dim>(make_law_by<dim>(
          [](const std::string &section) {
            return std::make_unique<Cone<dim>>(section);
          },
          sand.parameters()))
    {
      for (unsigned int d = 0; d < 3; ++d)
        points.data(points.stress, d)[0] = -2e3 - 100. * d;
      set_gradient(gradient());
    }

    static Matrix<dim, double>
    gradient()
    {
      std::mt19937 random(7);
      auto         H = random_matrix<dim>(random, 2e-3);
      H[0][1] += 0.02;
      return H;
    }

    void
    set_gradient(const Matrix<dim, double> &H)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          workspace.velocity_gradient(i, j)[0] = H[i][j];
    }

    double
    plastic_shear() const
    {
      return points.data(points.find("plastic shear strain"))[0];
    }
  };



  /// The stress lies on the cone. The mean stress is the elastic mean stress
  /// minus the bulk modulus times the dilation.
  template <int dim>
  void
  expect_stress_on_cone()
  {
    ConeStep<dim> step;
    const double  before = step.mean_stress();
    step.law->commit_load_step(step.points, step.workspace, 0, 1);
    const double tau = std::sqrt(0.5 * step.deviator_squared());
    EXPECT_NEAR(tau, cohesion - friction * step.mean_stress(), 1e-9 * tau);
    EXPECT_GT(step.plastic_shear(), 1e-3);
    const double volume = trace(ConeStep<dim>::gradient());
    EXPECT_NEAR(step.mean_stress() - before,
                sand.bulk * (volume - dilation * step.plastic_shear()),
                1e-11 * sand.bulk);
  }



  /// The tangent is the derivative of the stress.
  template <int dim>
  void
  expect_tangent()
  {
    ConeStep<dim> step;
    const auto    at = [&](const unsigned int k, const double change) {
      auto H = ConeStep<dim>::gradient();
      H[k / dim][k % dim] += change;
      step.set_gradient(H);
      StressTangent<dim> result;
      step.law->linearize(step.points, step.workspace, 0, 1, &result);
      return result;
    };
    const auto   tangent = at(0, 0.).tangent;
    const double eps     = 1e-6;
    for (unsigned int k = 0; k < dim * dim; ++k)
      {
        const auto plus = at(k, eps).stress, minus = at(k, -eps).stress;
        for (unsigned int i = 0; i < dim * dim; ++i)
          EXPECT_NEAR(tangent[i][k],
                      (plus[i] - minus[i]) / (2. * eps),
                      1e-7 * sand.mu);
      }
  }



  /// The elastic energy after a step of small strain is the energy of the
  /// stress: the remaining work of the step is plastic.
  template <int dim>
  void
  expect_energy_of_stress()
  {
    ConeStep<dim> step;
    const auto    energy = [&]() {
      return step.volume *
             (step.deviator_squared() / (4. * sand.mu) +
              step.mean_stress() * step.mean_stress() / (2. * sand.bulk));
    };
    const double before = energy();
    step.law->commit_load_step(step.points, step.workspace, 0, 1);
    EXPECT_NEAR(step.elastic_energy(), energy() - before, 1e-12 * before);
    EXPECT_GT(step.plastic_work(), 1e-3 * before);
  }



  TEST(ReturnMapping, StressOnConeWithDilation)
  {
    expect_stress_on_cone<2>();
    expect_stress_on_cone<3>();
  }



  TEST(ReturnMapping, TangentIsTheDerivativeOfTheStress)
  {
    expect_tangent<2>();
    expect_tangent<3>();
  }



  TEST(ReturnMapping, ElasticEnergyIsEnergyOfStress)
  {
    expect_energy_of_stress<2>();
    expect_energy_of_stress<3>();
  }
} // namespace return_mapping_test
