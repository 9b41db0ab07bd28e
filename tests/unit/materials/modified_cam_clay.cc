// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/dual.h>
#include <talus/base/errors.h>

#include <talus/materials/modified_cam_clay.h>

#include "specimen.h"

// Modified Cam clay against its closed forms at one point. Pressures in kPa
// where nothing else is said: the law has no scale of its own.

namespace cam_clay_test
{
  using namespace talus;

  constexpr double compression = 0.1, swelling = 0.02; // over 1 + e_0
  constexpr double Lambda = 0.8;                       // 1 - kappa/lambda

  /// Clay without attraction whose friction angle has the sine @p sine.
  CamClayFlow
  clay(const double sine)
  {
    return {std::tan(std::asin(sine)),
            1.5 * (1. - 2. * 0.3) / 1.3 / swelling,
            1. / swelling,
            1. / (compression - swelling),
            0.};
  }

  // The slope of the critical state in triaxial compression is 1.
  const CamClayFlow of_slope_one = clay(3. / 7.);



  /// Point strained by prescribed increments, in plane strain or with a strain
  /// out of the plane.
  struct Sample
  {
    CamClayFlow       flow_rule;
    Stress<2, double> sigma;
    double            preconsolidation;

    double
    pressure() const
    {
      return -mean_normal(sigma);
    }

    /// sqrt(3 s:s/2).
    double
    q() const
    {
      const auto s = add_mean(sigma, pressure());
      return std::sqrt(1.5 * contract(s, s));
    }

    /// Largest shear stress in the plane.
    double
    radius() const
    {
      return std::hypot(0.5 * (sigma[0] - sigma[1]), sigma[3]);
    }

    /// Stress after the @p strain xx, yy, zz and xy.
    template <typename Number>
    StressStep<2, Number>
    after(const Stress<2, Number> &strain,
          Flow<Number, Number>    *flow = nullptr) const
    {
      const double          p = pressure();
      const Number          m = mean_normal(strain);
      StressStep<2, Number> trial;
      const Number          bulk = flow_rule.bulk_modulus(p, Number(3. * m));
      trial.bulk                 = bulk;
      trial.mean_after           = 3. * m * bulk - p;
      for (unsigned int i = 0; i < 4; ++i)
        trial.deviator_after[i] =
          sigma[i] + (i < 3 ? p : 0.) +
          2. * p * flow_rule.shear_modulus * (strain[i] - (i < 3 ? m : 0.));
      const auto found =
        flow_rule(trial,
                  preconsolidation,
                  PointStrength<double>{0., 1., p, 1. / p, 1.});
      if (flow != nullptr)
        *flow = found;
      return returned(trial, bulk, found);
    }

    void
    step(const Stress<2, double> &strain)
    {
      Flow<double, double> flow;
      const auto           stress = after(strain, &flow);
      sigma = add_mean(stress.deviator_after, stress.mean_after);
      preconsolidation += flow.increment;
    }
  };



  // Along the lines of compression and swelling, p = p_c0 exp((eps -
  // kappa ln(p_c0/p_0))/lambda), 390.1536945 kPa, in steps of any size; back
  // along the line of swelling.
  TEST(ModifiedCamClay, IsotropicCompression)
  {
    for (const unsigned int n : {3, 40})
      {
        Sample sample{of_slope_one, {{-50., -50., -50., 0.}}, 100.};
        for (unsigned int i = 0; i < n; ++i)
          {
            const double e = -0.15 / 3. / n;
            sample.step({{e, e, e, 0.}});
          }
        EXPECT_NEAR(sample.pressure(), 390.1536945, 1e-7);
        EXPECT_NEAR(sample.preconsolidation, sample.pressure(), 1e-10);
        EXPECT_NEAR(sample.q(), 0., 1e-9);
        sample.step({{1e-2, 1e-2, 1e-2, 0.}});
        EXPECT_NEAR(sample.pressure(), 390.1536945 * std::exp(-1.5), 1e-7);
        EXPECT_NEAR(sample.preconsolidation, 390.1536945, 1e-7);
      }
  }



  // s_u/p_0 = (M/2) (R/2)^Lambda @cite wood1990, and on the way, at the slope
  // eta of the path, p/p_0 = (R/(1 + eta^2/M^2))^Lambda.
  TEST(ModifiedCamClay, UndrainedTriaxialCompression)
  {
    for (const auto &[R, strength] : {std::pair{1., 0.2871745887},
                                      {1.5, 0.3972089404},
                                      {2., 0.5},
                                      {4., 0.8705505633},
                                      {8., 1.5157165665}})
      {
        Sample sample{of_slope_one, {{-1., -1., -1., 0.}}, R};
        for (unsigned int i = 0; i < 600; ++i)
          {
            sample.step({{5e-4, -1e-3, 5e-4, 0.}});
            const double eta = sample.q() / sample.pressure();
            if (sample.preconsolidation == R)
              continue;
            EXPECT_NEAR(sample.pressure(),
                        std::pow(R / (1. + eta * eta), Lambda),
                        1e-9);
          }
        EXPECT_NEAR(0.5 * sample.q(), strength, 1e-6) << R;
      }
  }



  // Unless shear comes from the side of compression alone, the critical state
  // in plane strain is that of the friction angle: s_u = sin(phi) p_0 (p_c/(2
  // p_0))^Lambda. A circle fitted in triaxial compression would give a third
  // more.
  TEST(ModifiedCamClay, UndrainedPlaneStrain)
  {
    for (const auto &[phi, ratio, strength] :
         {std::tuple{25., 1., 0.2226595444},
          {25., 2., 0.4008836400},
          {25., 8., 1.3150673881},
          {30., 1., 0.2492428880},
          {30., 4., 0.8193869064}})
      {
        Specimen<2>  soil("modified Cam clay",
                         text("set Attraction = 1e-6\n"
                               "set Friction angle = ",
                              phi));
        const double sine = std::sin(phi * pi / 180.);
        const double K0   = (1. - sine) * std::pow(ratio, sine);
        store_stress<2, double>(soil.points,
                                0,
                                {{-1e5 * K0, -1e5, -1e5 * K0, 0.}});
        EXPECT_NEAR(soil.law->consolidate(soil.points, 0, 1e5, ratio),
                    1e5 * strength,
                    1e-5 * strength * 1e5);
        for (unsigned int i = 0; i < 4000; ++i)
          soil.step(simple_shear<2>(2e-4));
        const auto sigma = soil.stress();
        EXPECT_NEAR(std::hypot(0.5 * (sigma[0] - sigma[1]), sigma[3]),
                    1e5 * strength,
                    1e-5 * strength * 1e5)
          << phi << ' ' << ratio;
        // What shear_strength() bounds, in any state of the soil.
        EXPECT_NEAR(std::sqrt(0.5 * soil.deviator_squared()),
                    soil.law->shear_strength(soil.points, 0),
                    1e-5 * strength * 1e5);
      }
  }



  /// Sample of a random stress inside or on the yield surface.
  Sample
  random_sample(std::mt19937 &random)
  {
    std::uniform_real_distribution<double> part(0., 1.);
    Sample       sample{clay(0.2 + 0.3 * part(random)),
                  {{part(random) - 0.5,
                          part(random) - 0.5,
                          part(random) - 0.5,
                          part(random) - 0.5}},
                  100.};
    const double p = 100. * (0.02 + 0.97 * part(random));
    auto         s = add_mean(sample.sigma, -mean_normal(sample.sigma));
    const double q = std::sqrt(1.5 * contract(s, s));
    for (double &component : s)
      component *= 0.6 * part(random) * std::sqrt(p * (100. - p)) / q;
    sample.sigma = add_mean(s, -p);
    return sample;
  }



  // After a step the stress is inside the yield surface or on it, and on it the
  // plastic strain is normal to the ellipse: compression over shear as 2 p -
  // p_c to 2 q/M^2.
  TEST(ModifiedCamClay, ReturnsToTheYieldSurface)
  {
    std::mt19937                     random(1);
    std::normal_distribution<double> normal;
    unsigned int                     n_wet = 0, n_dry = 0;
    for (unsigned int i = 0; i < 4000; ++i)
      {
        Sample            sample = random_sample(random);
        const double      size   = std::pow(10., -6. + 5. * (i % 100) / 100.);
        Stress<2, double> strain;
        for (double &component : strain)
          component = size * normal(random);
        const double         p0 = sample.pressure();
        Flow<double, double> flow;
        const auto           after = sample.after(strain, &flow);
        const double         p_c   = sample.preconsolidation + flow.increment;
        const double         p     = -after.mean_after;
        ASSERT_GT(p, 0.);
        const auto end = sample.flow_rule.equation<2, double>(
          after, 1., p, std::sin(std::atan(sample.flow_rule.friction)));
        const double excess =
          (end.shear * end.shear + p * (p - p_c)) / (p_c * p_c);
        EXPECT_LE(excess, 1e-10);
        if (flow.increment == 0.)
          continue;
        EXPECT_GE(excess, -1e-10);
        (flow.increment > 0. ? n_wet : n_dry) += 1;
        // Plastic compression, and 2 G times the plastic multiplier.
        const double x = std::log(p_c / sample.preconsolidation) /
                         sample.flow_rule.plastic_rate;
        const double G = p0 * sample.flow_rule.shear_modulus;
        const double M = std::sqrt(3.) *
                         std::sqrt(0.5 * contract(after.deviator_after,
                                                  after.deviator_after)) /
                         end.shear;
        const double multiplier =
          (1. / (1. - flow.removed) - 1.) * M * M / (6. * G);
        EXPECT_NEAR(x, multiplier * (2. * p - p_c), 1e-7 * size);
      }
    EXPECT_GT(n_wet, 300u);
    EXPECT_GT(n_dry, 300u);
  }



  // Whatever the strength factor, the deviator that is left is on the yield
  // surface.
  TEST(ModifiedCamClay, SmallStrengthFactors)
  {
    const CamClayFlow flow_rule = clay(std::sin(25. * pi / 180.));
    for (double factor = 1.; factor > 1e-9; factor *= 0.3)
      for (const double ratio : {1., 1.9, 2.1, 8.})
        {
          StressStep<2, double> trial{};
          trial.mean_before = trial.mean_after = -10.;
          trial.bulk           = flow_rule.bulk_modulus(10., 0.);
          trial.deviator_after = {{0., 0., 0., 3.}};
          const auto flow =
            flow_rule(trial,
                      10. * ratio,
                      PointStrength<double>{0., factor, 10., 0.1, 1.});
          const auto   after = returned(trial, trial.bulk, flow);
          const double p     = -after.mean_after;
          const double p_c   = 10. * ratio + flow.increment;
          const double shear = after.deviator_after[3] / flow_rule.sine(factor);
          if (flow.removed == 0.)
            EXPECT_LE(shear * shear, p * (p_c - p)) << factor << ' ' << ratio;
          else
            EXPECT_NEAR(shear * shear, p * (p_c - p), 1e-7 * p_c * p_c)
              << factor << ' ' << ratio;
        }
  }



  // Derivatives of all components by Dual and by differences.
  TEST(ModifiedCamClay, Derivative)
  {
    std::mt19937                     random(3);
    std::normal_distribution<double> normal(0., 5e-3);
    for (unsigned int i = 0; i < 300; ++i)
      {
        const Sample      sample = random_sample(random);
        Stress<2, double> strain, direction;
        for (unsigned int c = 0; c < 4; ++c)
          {
            strain[c]    = normal(random);
            direction[c] = normal(random);
          }
        const auto at = [&](const auto &distance) {
          using Number = std::decay_t<decltype(distance)>;
          Stress<2, Number> moved;
          for (unsigned int c = 0; c < 4; ++c)
            moved[c] = Number(strain[c]) + direction[c] * distance;
          const auto stress = sample.after(moved);
          return add_mean(stress.deviator_after, stress.mean_after);
        };
        Dual<1> one;
        one.derivative[0]  = 1.;
        const auto   exact = at(one);
        const double d     = 1e-5;
        const auto   right = at(d), left = at(-d);
        for (unsigned int c = 0; c < 4; ++c)
          EXPECT_NEAR(exact[c].derivative[0],
                      (right[c] - left[c]) / (2. * d),
                      1e-4 * sample.pressure());
      }
  }



  // Soil that flows stays at the critical state, where the return is 0/0, and
  // soil torn apart keeps a stress, and bears load again.
  TEST(ModifiedCamClay, CriticalStateAndTornSoil)
  {
    Sample sample{of_slope_one, {{-1., -1., -1., 0.}}, 2.};
    for (unsigned int i = 0; i < 3000; ++i)
      sample.step({{0., 0., 0., 1e-3}});
    const double s_u = 3. / 7.;
    EXPECT_NEAR(sample.radius(), s_u, 1e-9);
    sample.step({{0., 0., 0., 1e-3}});
    EXPECT_NEAR(sample.radius(), s_u, 1e-9);
    sample.flow_rule.attraction = 0.1;
    Specimen<3> soil("modified Cam clay", "set Attraction = 100");
    soil.law->consolidate(soil.points, 0, 0., 1.);
    for (const double growth : {0.1, 0.1, -0.1, -0.1, -0.1})
      {
        Matrix<3, double> H{};
        for (unsigned int d = 0; d < 3; ++d)
          H[d][d] = growth;
        soil.step(H);
        EXPECT_LT(soil.mean_stress(), 100.);
      }
    EXPECT_LT(soil.mean_stress(), -1e3);
    EXPECT_GT(soil.wave_speed(), 0.);
  }
} // namespace cam_clay_test
