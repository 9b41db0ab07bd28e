// SPDX-License-Identifier: LGPL-2.1-or-later
// The effect of the rate of shearing on the strength, R = 1 + m asinh(gdot/
// gdot_ref).

#include <talus/base/errors.h>
#include <talus/materials/herschel_bulkley_kernel.h>
#include <talus/materials/rate_effect_kernel.h>
#include <talus/materials/von_mises_kernel.h>

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "load_step_setup.h"

namespace rate_effect_test
{
  using namespace talus;

  constexpr double               mu = 0.1, reference = 3e-6; // -, 1/s
  const Elastic                  stiff_soil{2.5e9, 0.49};
  const std::vector<std::string> laws = {"von Mises",
                                         "Bingham",
                                         "Herschel-Bulkley"};



  /// Law without viscosity, with @p more lines of parameters.
  std::string
  parameters(const std::string &law, const std::string &more = "")
  {
    std::ostringstream out;
    out << "set Undrained shear strength = " << s_u << '\n';
    if (law != "von Mises")
      out << "set " << (law == "Bingham" ? "Viscosity" : "Consistency")
          << " = 0\n";
    out << more;
    return out.str();
  }

  std::string
  with_rate(const std::string &law, const std::string &more = "")
  {
    return parameters(law,
                      text("set Rate coefficient = ",
                           mu,
                           "\nset Reference shear rate = ",
                           reference,
                           '\n',
                           more));
  }

  /// Softening to 0.4 times the strength over a plastic shear strain of 0.5,
  /// under Herschel-Bulkley by 95 %.
  std::string
  softening(const std::string &law)
  {
    return law == "von Mises"
             ? text("set Hardening modulus = ",
                    -3. * 0.6 * s_u / 0.5,
                    "\nset Residual undrained shear strength = ",
                    0.4 * s_u,
                    '\n')
             : "set Remoulded strength ratio = 0.4\n"
               "set Plastic shear strain to remould = 0.5\n";
  }

  double
  strength_at(const std::string &law, const double xi)
  {
    return law == "von Mises" ? s_u * std::max(1. - 0.6 * xi / 0.5, 0.4)
                              : s_u * (0.4 + 0.6 * std::exp(-3. * xi / 0.5));
  }



  double
  rate_factor(const double rate)
  {
    return 1. + mu / std::log(10.) * std::asinh(rate / reference);
  }

  double
  shear_stress(const Specimen<2> &soil)
  {
    return std::sqrt(0.5 * soil.deviator_squared());
  }

  double
  plastic_shear(const Specimen<2> &soil, const std::string &law)
  {
    return law == "von Mises"
             ? std::sqrt(3.) * soil.plastic_strain()
             : soil.points.data(soil.points.find("plastic shear strain"))[0];
  }



  /// Move @p soil by @p H in @p dt seconds.
  void
  move(Specimen<2> &soil, const Matrix<2, double> &H, const double dt)
  {
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        soil.workspace.velocity_gradient(i, j)[0] = H[i][j] / dt;
    soil.law->update_stress(soil.points, soil.workspace, 0, 1, dt);
  }



  // Elastic rotation and the normal stresses of the Jaumann rate add less than
  // (s_u/G)^2 = 1e-11.
  TEST(RateEffect, SimpleShear)
  {
    for (const std::string &law : laws)
      for (const double rate : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.})
        {
          Specimen<2> soil(law, stiff_soil.parameters(with_rate(law)));
          for (unsigned int step = 0; step < 100; ++step)
            move(soil, simple_shear<2>(1e-6), 1e-6 / rate);
          EXPECT_NEAR(soil.stress()[3] / s_u, rate_factor(rate), 1e-10)
            << law << " at " << rate << " 1/s";
        }
  }



  // After each step the stress is the present strength times R.
  TEST(RateEffect, SoftensAlongTheCurve)
  {
    for (const std::string &law : laws)
      for (const double rate : {1e-5, 1e-1})
        {
          Specimen<2> soil(
            law, stiff_soil.parameters(with_rate(law, softening(law))));
          const double dgamma = 2e-3;
          double       work   = 0.;
          for (unsigned int step = 0; step < 800; ++step)
            {
              const double tau = shear_stress(soil);
              const double xi  = plastic_shear(soil, law);
              move(soil, pure_shear(0.5 * dgamma), dgamma / rate);
              const double after = plastic_shear(soil, law);
              EXPECT_NEAR(shear_stress(soil),
                          strength_at(law, after) *
                            rate_factor((after - xi) / dgamma * rate),
                          1e-10 * s_u);
              work += 0.5 * (tau + shear_stress(soil)) * dgamma * soil.volume;
            }
          EXPECT_GT(plastic_shear(soil, law), 1.5);
          EXPECT_NEAR(soil.plastic_work() + soil.elastic_energy(),
                      work,
                      1e-10 * work);
        }
  }



  /// Line from @p S to the residual strength S - @p L, softening by @p decay L.
  LinearSoftening<double>
  line(const double S, const double L, const double decay, const double G)
  {
    return {S, 0., -L, -decay * L, G};
  }

  ExponentialSoftening<double>
  exponential(const double S,
              const double L,
              const double decay,
              const double G)
  {
    return {S, L, decay, G};
  }



  long double
  change_of_strength(const LinearSoftening<double> &curve, const long double x)
  {
    return std::max(curve.slope * x, (long double)curve.lowest);
  }

  long double
  change_of_strength(const ExponentialSoftening<double> &curve,
                     const long double                   x)
  {
    return curve.loss * std::expm1(-curve.decay * x);
  }



  /// The plastic variable by bisection of its logarithm in extended precision,
  /// from the equation as it stands.
  template <typename Curve>
  long double
  increment_by_bisection(const long double excess,
                         const Curve      &curve,
                         const RateEffect &rate)
  {
    long double low  = std::log(1e-300L);
    long double high = std::log((excess + curve.strength) / curve.modulus);
    while (high - low > 1e-17L * std::abs(low))
      {
        const long double middle = 0.5L * (low + high), x = std::exp(middle);
        const long double gain =
          rate.coefficient * std::asinh(x / (long double)rate.reference);
        const long double lost = change_of_strength(curve, x);
        const bool        is_above =
          curve.modulus * x + curve.strength * gain + lost * (1. + gain) >
          excess;
        if (middle == low || middle == high)
          break;
        (is_above ? high : low) = middle;
      }
    return std::exp(0.5L * (low + high));
  }



  /// @p Curve with several points at once.
  template <typename Number>
  LinearSoftening<Number>
  lanes(const LinearSoftening<double> &c)
  {
    return {c.strength, c.line, c.lowest, c.slope, c.modulus};
  }

  template <typename Number>
  ExponentialSoftening<Number>
  lanes(const ExponentialSoftening<double> &c)
  {
    return {c.strength, c.loss, c.decay, c.modulus};
  }



  /// Random numbers of the cases.
  struct Random
  {
    std::mt19937 engine{7};

    double
    uniform(const double from, const double to)
    {
      return from + (to - from) * (engine() / 4294967295.);
    }

    double
    magnitude(const double from, const double to)
    {
      return std::pow(10., uniform(from, to));
    }
  };



  constexpr unsigned int n_points = 8;

  /// Hold @p curve against bisection for some trial stresses, and several
  /// points at a time against one by one. Return the largest relative error.
  template <typename Curve>
  double
  largest_error(const Curve      &curve,
                const RateEffect &rate,
                const double      dt,
                Random           &random)
  {
    std::array<double, n_points> excess, together, alone;
    for (double &e : excess) // rates to 1e4/s, and strains to 1
      e = curve.modulus * random.magnitude(-6., 0.) * std::min(1e4 * dt, 1.);
    excess[3] *= -1.;
    for_each_simd(0, n_points, [&](const unsigned int i, const auto number) {
      using Number = std::decay_t<decltype(number)>;
      store(&together[i],
            plastic_increment(load<Number>(&excess[i]),
                              lanes<Number>(curve),
                              rate));
    });
    double largest = 0.;
    for (unsigned int i = 0; i < n_points; ++i)
      {
        store(&alone[i],
              plastic_increment(load<Simd<1>>(&excess[i]),
                                lanes<Simd<1>>(curve),
                                rate));
        EXPECT_EQ(together[i], alone[i]);
        if (excess[i] < 0.)
          EXPECT_EQ(together[i], 0.);
        else
          {
            const double error = std::abs(
              together[i] / increment_by_bisection(excess[i], curve, rate) -
              1.L);
            largest = std::isnan(error) ? 1. : std::max(largest, error);
          }
      }
    return largest;
  }



  // As close to the limit of softening as 1 %. 20 000 trial stresses per curve.
  TEST(RateEffect, ReturnIsTheRoot)
  {
    Random random;
    double worst = 0.;
    for (unsigned int batch = 0; batch < 2500; ++batch)
      {
        const double m              = random.uniform(0.01, 0.3) / std::log(10.);
        const double dt             = random.magnitude(-6., 0.),
                     G              = random.magnitude(4., 8.);
        const double reference_rate = random.magnitude(-8., 0.);
        const double S              = random.magnitude(1., 5.);
        const double L = batch % 3 == 0 ? 0. : S * random.uniform(0., 1.);
        const double limit =
          G / (1. + m * (std::asinh(1e4 / reference_rate) + 2.));
        const double decay =
          L > 0. ? limit / L / (1. + random.magnitude(-2., 2.)) : 0.;
        const RateEffect rate{m, reference_rate * dt};
        for (const double error :
             {largest_error(line(S, L, decay, G), rate, dt, random),
              largest_error(exponential(S, L, decay, G), rate, dt, random)})
          {
            worst = std::max(worst, error);
            ASSERT_LT(error, 1e-10) << "m " << m << " dt " << dt << " G " << G
                                    << " reference " << reference_rate << " S "
                                    << S << " L " << L << " decay " << decay;
          }
      }
    std::cout << "largest relative error " << worst << std::endl;
  }



  TEST(RateEffect, NoTimeNoFlow)
  {
    for (const std::string &law : laws)
      {
        Specimen<2> soil(law, stiff_soil.parameters(with_rate(law)));
        soil.points.data(soil.points.stress, 3)[0] = 2. * s_u;
        soil.law->update_stress(soil.points, soil.workspace, 0, 1, 0.);
        EXPECT_DOUBLE_EQ(soil.stress()[3], 2. * s_u);
        EXPECT_EQ(plastic_shear(soil, law), 0.);
      }
  }



  /// Shear @p soil in a load step of the static stages.
  void
  load(Specimen<2> &soil)
  {
    soil.workspace.velocity_gradient(0, 1)[0] = 0.05;
    soil.law->commit_load_step(soil.points, soil.workspace, 0, 1);
  }

  TEST(RateEffect, StaticStagesAreInfinitelySlow)
  {
    for (const std::string &law : laws)
      {
        const std::string soft = softening(law);
        Specimen<2> soil(law, stiff_soil.parameters(with_rate(law, soft)));
        Specimen<2> at_rest(law, stiff_soil.parameters(parameters(law, soft)));
        load(soil);
        load(at_rest);
        EXPECT_EQ(soil.stress(), at_rest.stress());
        EXPECT_GT(plastic_shear(soil, law), 0.04);
        EXPECT_LE(soil.law->shear_strength(soil.points, 0), s_u);
      }
  }



  TEST(RateEffect, MultipliesTheStrengthFactor)
  {
    for (const std::string &law : laws)
      {
        Specimen<2>        soil(law, stiff_soil.parameters(with_rate(law)));
        const unsigned int column = soil.points.add_column("strength factor",
                                                           "-",
                                                           1,
                                                           Inheritance::copied);
        soil.law->use_strength_factor(column);
        soil.points.data(column)[0] = 0.3;
        for (unsigned int step = 0; step < 100; ++step)
          move(soil, simple_shear<2>(1e-6), 1e-4);
        EXPECT_NEAR(soil.stress()[3],
                    0.3 * s_u * rate_factor(1e-2),
                    1e-9 * s_u);
      }
  }



  // Also on cells of several sizes. Bit by bit are the returns of
  // ReturnIsTheRoot; the trial stress differs by round-off.
  TEST(RateEffect, BatchEqualsPointByPoint)
  {
    constexpr unsigned int n = 43;
    for (const std::string &law : laws)
      for (const bool by_displacement : {false, true})
        {
          const std::string soft =
            by_displacement
              ? "set Softening displacement = 0.2\n" +
                  (law == "von Mises" ? std::string()
                                      : "set Remoulded strength ratio = 0.4\n")
              : softening(law);
          const std::string all = paper.parameters(with_rate(law, soft));
          Specimen<2>       batch(law, all, n), single(law, all, n);
          std::mt19937      random(7);
          for (unsigned int p = 0; p < n && by_displacement; ++p)
            for (Specimen<2> *soil : {&batch, &single})
              soil->points.data(soil->points.find("cell size"))[p] =
                0.5 / (1 + p % 4);
          for (unsigned int step = 0; step < 10; ++step)
            {
              for (unsigned int p = 0; p < n; ++p)
                {
                  const auto H =
                    random_matrix<2>(random, p % 3 == 0 ? 1e-4 : 0.03);
                  batch.set_increment(H, p);
                  single.step(H, p);
                }
              batch.law->update_stress(
                batch.points, batch.workspace, 0, n, batch.dt);
            }
          const unsigned int plastic = batch.points.find(
            law == "von Mises" ? "plastic strain" : "plastic shear strain");
          EXPECT_GT(batch.points.data(plastic)[1], 0.01);
          for (unsigned int p = 0; p < n; ++p)
            {
              expect_near(batch.stress(p),
                          single.stress(p),
                          1e-13 * paper.bulk);
              EXPECT_NEAR(batch.points.data(plastic)[p],
                          single.points.data(plastic)[p],
                          1e-13);
            }
        }
  }



  /// What check() says, without line breaks; empty if nothing.
  std::string
  sentence(const std::string &law, const std::string &lines)
  {
    std::string line, word;
    try
      {
        make_law<2>(law, stiff_soil.parameters(lines));
      }
    catch (const ExcUser &error)
      {
        std::istringstream words(error.what());
        while (words >> word)
          line += word + ' ';
      }
    return line;
  }



  // With the largest rate coefficient the soil passes.
  TEST(RateEffect, TooSteepSofteningIsRefused)
  {
    for (const std::string &law : laws)
      {
        // The steepest softening is 0.8 G.
        std::ostringstream soft;
        soft.precision(17);
        if (law == "von Mises")
          soft << "set Hardening modulus = " << -3. * 0.8 * stiff_soil.mu;
        else
          soft << "set Remoulded strength ratio = 0\n"
               << "set Plastic shear strain to remould = "
               << 3. * s_u / (0.8 * stiff_soil.mu);
        const auto by = [&](const double coefficient) {
          return sentence(law,
                          parameters(law,
                                     text(std::setprecision(12),
                                          soft.str(),
                                          "\nset Rate coefficient = ",
                                          coefficient)));
        };
        EXPECT_NE(by(0.1).find("a smaller `Rate coefficient`"),
                  std::string::npos);
        const double largest = std::log(10.) * (0.99 / 0.8 - 1.) /
                               (std::asinh(1e4 / reference) + 2.);
        EXPECT_EQ(by(0.999 * largest), "");
        EXPECT_NE(by(1.001 * largest), "");
      }
  }



  TEST(RateEffect, LimitOfStrengthFactorKnowsTheRate)
  {
    for (const std::string &law : laws)
      {
        const std::string soft =
          "set Softening displacement = 0.2\n" +
          std::string(
            law == "von Mises" ? "" : "set Remoulded strength ratio = 0\n");
        const auto factor = [&](const std::string &lines) {
          const auto soil = make_law<2>(law, stiff_soil.parameters(lines));
          soil->use_cell_size(0.5);
          return soil->largest_strength_factor({s_u, s_u});
        };
        const double m = mu / std::log(10.);
        EXPECT_NEAR(factor(parameters(law, soft)) /
                      factor(with_rate(law, soft)),
                    rate_factor(1e4) + 2. * m,
                    1e-12);
      }
  }



  TEST(RateEffect, ViscosityIsRefused)
  {
    for (const std::string name : {"Viscosity", "Consistency"})
      EXPECT_NE(sentence(name == "Viscosity" ? "Bingham" : "Herschel-Bulkley",
                         "set Rate coefficient = 0.1\nset " + name + " = 3")
                  .find("`" + name + "` is 3, but only one of them"),
                std::string::npos);
  }
} // namespace rate_effect_test
