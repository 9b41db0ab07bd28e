// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/dual.h>
#include <talus/materials/mohr_coulomb_kernel.h>

#include <deal.II/base/symmetric_tensor.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "specimen.h"

// The return of MohrCoulombFlow against the criterion by principal stresses.

namespace mohr_coulomb_test
{
  using namespace talus;

  constexpr double mu = 8e6, bulk = 17e6; // Pa
  constexpr double phi = 0.5, psi = 0.2;  // radians
  constexpr double cohesion = 2e3;        // Pa

  const MohrCoulombFlow sand{mu, bulk, cohesion, std::tan(phi), psi, 0., 1e9};
  const PointStrength<double> whole{0., 1., 1., 1., 1.};



  /// Trial of a mean stress and random shear, Pa.
  template <int dim>
  StressStep<dim, double>
  trial_at(const double mean, std::mt19937 &random)
  {
    std::normal_distribution<double> normal(0., 40e3);
    StressStep<dim, double>          trial{};
    for (double &component : trial.deviator_after)
      component = normal(random);
    trial.deviator_after =
      add_mean(trial.deviator_after, -mean_normal(trial.deviator_after));
    trial.mean_after = mean;
    return trial;
  }



  /// Shear stress of the criterion less the strength at the stress, over the
  /// strength.
  template <int dim>
  double
  excess(const StressStep<dim, double> &stress)
  {
    dealii::SymmetricTensor<2, 3> sigma;
    if (dim == 2)
      sigma[2][2] = -(stress.deviator_after[stress_index<dim>(0, 0)] +
                      stress.deviator_after[stress_index<dim>(1, 1)]);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        sigma[i][j] = stress.deviator_after[stress_index<dim>(i, j)];
    const auto   s     = dealii::eigenvalues(sigma); // the largest first
    const double shear = 0.5 * (s[0] - s[2]);
    const double strength =
      cohesion * std::cos(phi) -
      (stress.mean_after + 0.5 * (s[0] + s[2])) * std::sin(phi);
    return shear / strength - 1.;
  }



  // In plane strain the criterion is met exactly; rounded corners of 3-D take
  // up to 0.4 % of the strength.
  template <int dim>
  void
  expect_return(const double tolerance)
  {
    std::mt19937 random(1);
    unsigned int n_yielding = 0;
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const auto trial = trial_at<dim>(-60e3, random);
        const auto flow  = sand(trial, 0., whole);
        if (flow.increment == 0.)
          {
            EXPECT_EQ(flow.removed, 0.);
            EXPECT_LE(excess(trial), tolerance);
            continue;
          }
        ++n_yielding;
        const auto after = returned(trial, bulk, flow);
        EXPECT_LE(excess(after), 1e-12);
        EXPECT_GE(excess(after), -tolerance);
        // sin(psi) in plane strain, where the largest shear strain is sqrt(1 +
        // (dilation per shear strain)^2/3) times that of the deviator.
        const double rate = flow.dilation / flow.increment;
        EXPECT_NEAR(rate / std::sqrt(1. - rate * rate / 3.),
                    std::sin(psi),
                    1e-12);
      }
    EXPECT_GT(n_yielding, 500u);
  }



  TEST(MohrCoulomb, ReturnsToTheYieldSurface)
  {
    expect_return<2>(1e-12);
    expect_return<3>(4e-3);
  }



  // Tension returns to the apex, or to the cut-off before it.
  TEST(MohrCoulomb, Tension)
  {
    std::mt19937 random(2);
    for (const double cut_off : {1e9, 1e3})
      {
        MohrCoulombFlow flow_rule = sand;
        flow_rule.tension         = cut_off;
        const double apex         = std::min(cut_off, cohesion / std::tan(phi));
        for (unsigned int i = 0; i < 200; ++i)
          {
            const auto trial = trial_at<3>(80e3, random);
            const auto after =
              returned(trial, bulk, flow_rule(trial, 0., whole));
            EXPECT_NEAR(after.mean_after, apex, 1e-9 * bulk);
            if (cut_off < 1e9)
              EXPECT_LE(excess(after), 1e-12);
            else
              for (const double s : after.deviator_after)
                EXPECT_NEAR(s, 0., 1e-4);
          }
      }
  }



  // Level ground at rest has two equal principal stresses, where the criterion
  // has corners, and a fluid has three.
  TEST(MohrCoulomb, StatesWithoutDirection)
  {
    for (const double s : {0., 50e3, -50e3})
      {
        StressStep<3, Dual<1>> trial;
        trial.mean_after = -60e3;
        for (unsigned int c = 0; c < 6; ++c)
          trial.deviator_after[c] = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          trial.deviator_after[stress_index<3>(d, d)] = (d == 1 ? 2. : -1.) * s;
        trial.deviator_after[stress_index<3>(0, 1)].derivative[0] = 1.;
        const auto flow = sand(trial, 0., whole);
        for (const auto &number : {flow.removed, flow.increment, flow.dilation})
          {
            EXPECT_TRUE(std::isfinite(number.value)) << s;
            EXPECT_TRUE(std::isfinite(number.derivative[0])) << s;
          }
        EXPECT_EQ(flow.increment.value > 0., s != 0.);
      }
  }



  /// Derivative of the mean stress and of a shear stress after the return along
  /// a random direction, by Dual and by differences.
  template <int dim>
  void
  expect_derivative()
  {
    std::mt19937 random(3);
    for (unsigned int i = 0; i < 200; ++i)
      {
        const auto trial     = trial_at<dim>(-60e3, random);
        const auto direction = trial_at<dim>(1e4, random);
        const auto at        = [&](const auto &distance) {
          using Number = std::decay_t<decltype(distance)>;
          StressStep<dim, Number> moved;
          moved.mean_after =
            Number(trial.mean_after) + direction.mean_after * distance;
          for (unsigned int c = 0; c < moved.deviator_after.size(); ++c)
            moved.deviator_after[c] = Number(trial.deviator_after[c]) +
                                      direction.deviator_after[c] * distance;
          return returned(moved, Number(bulk), sand(moved, 0., whole));
        };
        Dual<1> one;
        one.derivative[0]  = 1.;
        const auto   exact = at(one);
        const double d     = 1e-5;
        const auto   right = at(d), left = at(-d);
        const double scale = std::abs(direction.deviator_after[0]) + 1e4;
        EXPECT_NEAR(exact.mean_after.derivative[0],
                    (right.mean_after - left.mean_after) / (2. * d),
                    1e-3 * scale);
        EXPECT_NEAR(exact.deviator_after[0].derivative[0],
                    (right.deviator_after[0] - left.deviator_after[0]) /
                      (2. * d),
                    1e-3 * scale);
      }
  }



  TEST(MohrCoulomb, Derivative)
  {
    expect_derivative<2>();
    expect_derivative<3>();
  }



  // Dilation fades by 1/e over the dilation strain, and is never more than
  // associated flow with the reduced friction.
  TEST(MohrCoulomb, Dilation)
  {
    MohrCoulombFlow flow_rule = sand;
    flow_rule.decay           = 1. / 0.05;
    EXPECT_NEAR(flow_rule.dilatancy_sine(0.05, 0.4),
                std::sin(psi * std::exp(-1.)),
                1e-14);
    EXPECT_EQ(sand.dilatancy_sine(0.05, 0.1), 0.1);
  }



  /// Point in plane strain, of friction angle 30 degrees, at a normal stress of
  /// 100 kPa.
  struct Sample
  {
    MohrCoulombFlow   flow_rule;
    Stress<2, double> sigma; ///< Pa
    /// Volumetric over largest shear strain of the last step [-].
    double dilation = 0.;

    Sample(const double psi_in_degrees, const double c, const double K0)
      : flow_rule{mu,
                  bulk,
                  c,
                  std::tan(M_PI / 6.),
                  psi_in_degrees * M_PI / 180.,
                  0.,
                  1e9}
      , sigma{{-100e3 * K0, -100e3, -100e3 * K0, 0.}}
    {}

    /// Strain by @p strain, xx, yy, zz and xy. Its component @p free takes the
    /// value that keeps the normal stress there.
    void
    step(Stress<2, Dual<1>> strain, const unsigned int free)
    {
      const double kept = sigma[free], mean = mean_normal(sigma);
      strain[free].derivative[0] = 1.;
      StressStep<2, Dual<1>> after;
      Dual<1>                error;
      do
        {
          const Dual<1> m  = mean_normal(strain);
          after.mean_after = mean + 3. * bulk * m;
          for (unsigned int i = 0; i < 4; ++i)
            after.deviator_after[i] =
              sigma[i] + 2. * mu * strain[i] -
              (i < 3 ? mean + 2. * mu * m : Dual<1>(0.));
          after = returned(after, Dual<1>(bulk), flow_rule(after, 0., whole));
          error = after.deviator_after[free] + after.mean_after - kept;
          strain[free].value -= error.value / error.derivative[0];
      } while (std::abs(error.value) > 1e-7);
      for (unsigned int i = 0; i < 4; ++i)
        sigma[i] =
          after.deviator_after[i].value + (i < 3 ? after.mean_after.value : 0.);
      dilation =
        3. * mean_normal(strain).value /
        std::hypot(strain[0].value - strain[1].value, 2. * strain[3].value);
    }
  };



  // An infinite slope of 10 degrees at rest, in units of the stress across:
  // (s_1 - s_3)/2 is r = hypot(0.25, tan(10 degrees)), and the principal
  // deviators in the plane have the mean -(1 - K0)/6.
  TEST(MohrCoulomb, MobilizedStrengthOfASlope)
  {
    Specimen<2>  soil("Mohr-Coulomb", "set Friction angle = 30");
    const double shear = std::tan(M_PI / 18.);
    store_stress<2, double>(soil.points, 0, {{-5e4, -1e5, -5e4, 1e5 * shear}});
    EXPECT_NEAR(soil.law->mobilized_strength(soil.points, 0),
                (std::hypot(0.25, shear) - 0.5 / 12.) / (2. / 3. * 0.5),
                1e-12);
    store_stress<2, double>(soil.points, 0, {});
    EXPECT_EQ(soil.law->mobilized_strength(soil.points, 0), 1.);
  }



  // s_1 = K_p s_3 + 2 c sqrt(K_p).
  TEST(MohrCoulomb, BiaxialCompression)
  {
    for (const auto &[psi_in_degrees, c] :
         {std::pair{0., 0.}, {0., 5e3}, {10., 0.}, {30., 5e3}})
      {
        Sample sample(psi_in_degrees, c, 1.);
        for (unsigned int i = 0; i < 600; ++i)
          sample.step({{0., -1e-4, 0., 0.}}, 0);
        EXPECT_NEAR(-sample.sigma[1], 300e3 + 2. * c * std::sqrt(3.), 0.3);
        EXPECT_NEAR(sample.dilation,
                    std::sin(psi_in_degrees * M_PI / 180.),
                    5e-3);
      }
  }



  // Soil that shears without extension along the shear plane has
  // tau/s = sin(phi) cos(psi)/(1 - sin(phi) sin(psi)) @cite davis1968: 0.5,
  // 0.53922 and tan(phi). Across the shear plane and along it act
  // m (1 -+ sin(phi) sin(psi)).
  TEST(MohrCoulomb, SimpleShear)
  {
    for (const double psi_in_degrees : {0., 10., 30.})
      {
        Sample sample(psi_in_degrees, 0., 0.5);
        for (unsigned int i = 0; i < 40000; ++i)
          sample.step({{0., 0., 0., 2.5e-5}}, 1);
        const double angle = psi_in_degrees * M_PI / 180.;
        const double share = 0.5 * std::sin(angle);
        EXPECT_NEAR(sample.sigma[3] / 100e3,
                    0.5 * std::cos(angle) / (1. - share),
                    5e-4);
        EXPECT_NEAR(sample.sigma[0] / sample.sigma[1],
                    (1. + share) / (1. - share),
                    1e-3);
      }
  }
} // namespace mohr_coulomb_test
