// SPDX-License-Identifier: LGPL-2.1-or-later
// The strength factor of the points, a column, in the laws that have a
// strength.

#include <talus/base/errors.h>

#include "specimen.h"

using namespace talus;

namespace
{
  /// Of von Mises' law or of Bingham's, both softening, with all strengths
  /// times @p f.
  std::string
  parameters(const std::string &name, const double f)
  {
    std::ostringstream out;
    out.precision(17);
    out << "set Undrained shear strength = " << f * s_u << '\n';
    if (name == "von Mises")
      out << "set Hardening modulus = " << -0.01 * f * paper.E
          << "\nset Residual undrained shear strength = " << 0.4 * f * s_u;
    else
      out << "set Viscosity = 300\nset Remoulded strength ratio = 0.3\n"
          << "set Plastic shear strain to remould = 2";
    return paper.parameters(out.str());
  }



  /// Add the column to @p soil.
  template <int dim>
  double *
  add_factor(Specimen<dim> &soil)
  {
    const unsigned int column =
      soil.points.add_column("strength factor", "-", 1, Inheritance::copied);
    soil.law->use_strength_factor(column);
    soil.law->initialize(soil.points, 0, soil.points.size());
    return soil.points.data(column);
  }



  template <int dim>
  double
  stored_by_shear(const Specimen<dim> &soil, const unsigned int p = 0)
  {
    return soil.volume * soil.deviator_squared(p) / (4. * paper.mu);
  }



  const std::vector<std::string> laws_with_strength = {"von Mises", "Bingham"};
} // namespace



TEST(StrengthFactor, WhoHasAStrength)
{
  for (const std::string &name : material_names<2>())
    {
      Specimen<2> soil(name, paper.parameters_of(name));
      const bool  is_cohesive =
        name == "von Mises" || name == "Bingham" || name == "Herschel-Bulkley";
      const bool has_strength =
        is_cohesive || name == "Mohr-Coulomb" || name == "modified Cam clay";
      EXPECT_EQ(soil.law->has_strength(), has_strength) << name;
      if (has_strength && !is_cohesive)
        continue; // no undrained shear strength
      if (!has_strength)
        {
          EXPECT_TRUE(std::isinf(soil.law->shear_strength(soil.points, 0)));
          continue;
        }
      EXPECT_DOUBLE_EQ(soil.law->shear_strength(soil.points, 0), s_u);
      add_factor(soil)[0] = 0.3;
      EXPECT_DOUBLE_EQ(soil.law->shear_strength(soil.points, 0), 0.3 * s_u);
    }
}



// 1 changes nothing, f is f times all strengths, and neighbours in the same
// register do not matter.
TEST(StrengthFactor, MultipliesTheStrength)
{
  constexpr unsigned int n = 11;
  for (const std::string &name : laws_with_strength)
    {
      Specimen<3>   plain(name, parameters(name, 1.), n);
      Specimen<3>   one(name, parameters(name, 1.), n);
      Specimen<3>   half(name, parameters(name, 0.5), n);
      Specimen<3>   mixed(name, parameters(name, 1.), n);
      double *const factor_of_one   = add_factor(one);
      double *const factor_of_mixed = add_factor(mixed);
      for (unsigned int p = 0; p < n; p += 2)
        factor_of_mixed[p] = 0.5;
      EXPECT_EQ(factor_of_one[n - 1], 1.);
      std::mt19937 random(5);
      for (unsigned int step = 0; step < 100; ++step)
        {
          for (unsigned int p = 0; p < n; ++p)
            {
              const auto H = random_matrix<3>(random, 0.02);
              for (Specimen<3> *soil : {&plain, &one, &half, &mixed})
                soil->set_increment(H, p);
            }
          for (Specimen<3> *soil : {&plain, &one, &half, &mixed})
            soil->law->update_stress(
              soil->points, soil->workspace, 0, n, soil->dt);
        }
      for (unsigned int p = 0; p < n; ++p)
        {
          const Specimen<3> &same = (p % 2 == 0 ? half : plain);
          expect_near(mixed.stress(p), same.stress(p), 1e-12 * paper.bulk);
          EXPECT_NEAR(mixed.law->shear_strength(mixed.points, p),
                      same.law->shear_strength(same.points, p),
                      1e-12 * s_u);
          EXPECT_LT(mixed.law->shear_strength(mixed.points, p),
                    0.99 * (p % 2 == 0 ? 0.5 : 1.) * s_u)
            << "The test does not soften.";
          expect_near(one.stress(p), plain.stress(p), 1e-12 * paper.bulk);
        }
    }
}



// Up to this factor the return is that of a material which could be given as it
// is, beyond it the same material is refused.
TEST(StrengthFactor, OfSoilThatSoftensIsLimited)
{
  for (const std::string name : {"von Mises", "Bingham"})
    {
      Specimen<2>  soil(name, parameters(name, 1.));
      const double largest  = soil.law->largest_strength_factor({s_u, s_u});
      const double expected = name == "von Mises"
                                ? 3. * paper.mu / (0.01 * paper.E)
                                : paper.mu * 2. / (3. * 0.7 * s_u);
      EXPECT_NEAR(largest, 0.99 * expected, 1e-12 * expected);
      EXPECT_NO_THROW(Specimen<2>(name, parameters(name, 0.999 * largest)));
      EXPECT_THROW(Specimen<2>(name, parameters(name, 1.001 * largest)),
                   ExcUser);
    }
  for (const std::string &name : material_names<2>())
    EXPECT_TRUE(std::isinf(Specimen<2>(name, paper.parameters_of(name))
                             .law->largest_strength_factor({s_u, s_u})))
      << name;
}



// The strength falls and nothing moves: the stress outside the yield surface
// comes back to it, and what the shear had stored, V s:s/(4 mu), becomes
// plastic work. The trapezoidal rule is exact here.
TEST(StrengthFactor, SuddenDropReleasesWhatWasStored)
{
  for (const std::string name : {"von Mises", "Herschel-Bulkley"})
    for (const double fraction : {0.4, 0.})
      {
        const bool  is_viscoplastic = (name != "von Mises");
        Specimen<3> soil(name,
                         paper.parameters(
                           "set Undrained shear strength = 2500\n" +
                           std::string(is_viscoplastic ? "set Consistency = 0"
                                                       : "")));
        const auto &points = soil.points;
        double     *factor = add_factor(soil);
        // Loaded up to the yield stress, with rotation.
        std::mt19937 random(7);
        const auto   H = random_matrix<3>(random, 2e-3);
        for (unsigned int step = 0; step < 200; ++step)
          soil.step(H);
        const double mean    = soil.mean_stress();
        const double stored  = stored_by_shear(soil);
        const double elastic = soil.elastic_energy(),
                     plastic = soil.plastic_work();
        const double volume  = determinant(soil.F());
        ASSERT_NEAR(std::sqrt(0.5 * soil.deviator_squared()), s_u, 1e-9 * s_u);

        *factor = fraction;
        soil.step({});
        const double tau = std::sqrt(0.5 * soil.deviator_squared());
        EXPECT_NEAR(tau, fraction * s_u, 1e-11 * s_u);
        EXPECT_NEAR(tau, soil.law->shear_strength(points, 0), 1e-11 * s_u);
        EXPECT_NEAR(soil.law->mobilized_strength(points, 0), 1., 1e-11);
        EXPECT_NEAR(soil.mean_stress(), mean, 1e-12 * paper.bulk);
        const double released = volume * (stored - stored_by_shear(soil));
        EXPECT_NEAR(released,
                    volume * (1. - fraction * fraction) * stored,
                    1e-11 * stored);
        EXPECT_NEAR(soil.plastic_work() - plastic, released, 1e-12 * stored);
        EXPECT_NEAR(elastic - soil.elastic_energy(), released, 1e-12 * stored);
      }
}



// The strength falls while the soil is sheared, at constant volume and without
// rotation: stored is V s:s/(4 mu) at any time, the rest of the work is
// plastic.
TEST(StrengthFactor, WorkIsStoredOrDissipatedWhileItFalls)
{
  for (const std::string &name : laws_with_strength)
    {
      Specimen<2>  soil(name, parameters(name, 1.));
      double      *factor = add_factor(soil);
      const double g      = 1e-3; // of mid-step: diag(g, -g)
      double       work   = 0.;
      for (unsigned int step = 0; step < 400; ++step)
        {
          const double before = soil.stress()[0] - soil.stress()[1];
          *factor             = std::max(0.1, 1. - step / 200.);
          soil.step(
            {{{{{g / (1. - g / 2.), 0.}}, {{0., -g / (1. + g / 2.)}}}}});
          const double after = soil.stress()[0] - soil.stress()[1];
          work += soil.volume * 0.5 * (before + after) * g;
          EXPECT_NEAR(soil.elastic_energy(),
                      stored_by_shear(soil),
                      1e-11 * work);
        }
      EXPECT_NEAR(soil.elastic_energy() + soil.plastic_work(),
                  work,
                  1e-11 * work);
      EXPECT_GT(soil.plastic_work(), 0.9 * work);
    }
}
