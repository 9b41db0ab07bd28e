// SPDX-License-Identifier: LGPL-2.1-or-later
// The viscoplastic laws Herschel-Bulkley and Bingham.

#include <talus/base/errors.h>

#include "specimen.h"

using namespace talus;

namespace
{
  /// So stiff that the Jaumann rate's normal stresses do not show.
  const Elastic stiff_soil{2.5e9, 0.49};



  /// "set" lines from names and numbers.
  std::string
  lines(const std::vector<std::pair<std::string, double>> &values)
  {
    std::ostringstream out;
    out.precision(17);
    out << "set Undrained shear strength = " << s_u << '\n';
    for (const auto &[name, value] : values)
      out << "set " << name << " = " << value << '\n';
    return out.str();
  }



  std::string
  herschel_bulkley(const double K, const double n, const double r = 1.)
  {
    return lines({{"Consistency", K},
                  {"Flow exponent", n},
                  {"Remoulded strength ratio", r}});
  }



  double
  shear_stress(const Specimen<2> &soil, const unsigned int p = 0)
  {
    return std::sqrt(0.5 * soil.deviator_squared(p));
  }



  double
  plastic_shear_strain(const Specimen<2> &soil, const unsigned int p = 0)
  {
    return soil.points.data(soil.points.find("plastic shear strain"))[p];
  }



  /// What check() says to @p parameters, without line breaks; empty if nothing.
  std::string
  error(const std::string &name, const std::string &parameters)
  {
    std::string line, word;
    try
      {
        make_law<2>(name, parameters);
      }
    catch (const ExcUser &error)
      {
        std::istringstream words(error.what());
        while (words >> word)
          line += word + ' ';
      }
    return line;
  }
} // namespace



TEST(Viscoplastic, NoTimeNoFlow)
{
  Specimen<2> soil("Herschel-Bulkley",
                   stiff_soil.parameters(herschel_bulkley(10., 0.4)));
  soil.points.data(soil.points.stress, 3)[0] = 2. * s_u;
  soil.law->update_stress(soil.points, soil.workspace, 0, 1, 0.);
  EXPECT_DOUBLE_EQ(soil.stress()[3], 2. * s_u);
  EXPECT_EQ(plastic_shear_strain(soil), 0.);
}



// In steps of dgamma the stress ends at (sxx, sxy) = R (cos(t), sin(t)). With
// the half rotation a of rate_laws.cc, what a step adds and the return removes
// are i mu dgamma = (R + mu D) exp(i (t + a)) - R exp(i (t - a)), so the
// plastic shear is D = dgamma sin(t)/cos(a): backward Euler is exact where
// nothing changes. In small steps sxy is s_u + K rate^n.
TEST(Viscoplastic, SteadySimpleShear)
{
  const auto check =
    [](const std::string &name, const std::string &more, const double n) {
      for (const double rate : {0.01, 10.})
        {
          Specimen<2>  soil(name, stiff_soil.parameters(more));
          const double dgamma = rate * soil.dt;
          for (unsigned int step = 0; step < 300; ++step)
            soil.step(simple_shear<2>(dgamma));
          const double R = shear_stress(soil), a = 2. * std::atan(dgamma / 4.);
          const double D = dgamma * soil.stress()[3] / R / std::cos(a);
          EXPECT_NEAR(R, s_u + 80. * std::pow(D / soil.dt, n), 1e-10 * R);
          const double limit = s_u + 80. * std::pow(rate, n);
          EXPECT_NEAR(soil.stress()[3], limit, 0.15 * dgamma * dgamma * limit);
        }
    };
  for (const double n : {0.3, 1., 1.7})
    check("Herschel-Bulkley", herschel_bulkley(80., n), n);
  check("Bingham", lines({{"Viscosity", 80.}}), 1.);
}



// Strain is held: overstress y with G y' = ... n = 1: (1 + G dt/K)^-k after k
// steps. n = 1/2: dy/dt = -G (y/K)^2, so 1/y grows linearly; the backward Euler
// method comes up to it with first order.
TEST(Viscoplastic, Relaxation)
{
  const Elastic soft{250e3, 0.49};
  const double  K = 5e4, start = 3. * s_u;
  Specimen<2>   linear("Bingham", soft.parameters(lines({{"Viscosity", K}})));
  linear.points.data(linear.points.stress, 3)[0] = s_u + start;
  linear.set_increment({});
  for (unsigned int k = 1; k <= 40; ++k)
    {
      linear.law->update_stress(
        linear.points, linear.workspace, 0, 1, linear.dt);
      EXPECT_NEAR(shear_stress(linear) - s_u,
                  start * std::pow(1. + soft.mu * linear.dt / K, -1. * k),
                  1e-11 * start);
    }

  double error[2];
  for (const unsigned int i : {0, 1})
    {
      Specimen<2> soil("Herschel-Bulkley",
                       soft.parameters(herschel_bulkley(3e3, 0.5)));
      soil.points.data(soil.points.stress, 3)[0] = s_u + start;
      soil.set_increment({});
      const unsigned int n_steps = (i == 0 ? 1000 : 2000);
      for (unsigned int k = 0; k < n_steps; ++k)
        soil.law->update_stress(
          soil.points, soil.workspace, 0, 1, 0.1 / n_steps);
      const double exact = 1. / (1. / start + soft.mu * 0.1 / (3e3 * 3e3));
      error[i]           = shear_stress(soil) - s_u - exact;
    }
  EXPECT_LT(std::abs(error[0]), 0.01 * start);
  EXPECT_NEAR(error[0] / error[1], 2., 0.02);
}



// Without viscosity and remoulding it is von Mises' law.
TEST(Viscoplastic, AgreesWithVonMises)
{
  const Elastic clay{250e3, 0.49};
  Specimen<3>   flow("Herschel-Bulkley",
                   clay.parameters(herschel_bulkley(0., 0.5)));
  Specimen<3>   mises("von Mises", clay.parameters(lines({})));
  std::mt19937  random(3);
  for (unsigned int step = 0; step < 500; ++step)
    {
      const auto H = random_matrix<3>(random, 0.01);
      flow.step(H);
      mises.step(H);
    }
  expect_near(flow.stress(), mises.stress(), 1e-12 * clay.bulk);
  EXPECT_GT(mises.plastic_strain(), 1.);
  EXPECT_NEAR(flow.points.data(flow.points.find("plastic shear strain"))[0],
              std::sqrt(3.) * mises.plastic_strain(),
              1e-12 * mises.plastic_strain());
  EXPECT_NEAR(flow.plastic_work(),
              mises.plastic_work(),
              1e-12 * mises.plastic_work());
  EXPECT_NEAR(flow.elastic_energy(),
              mises.elastic_energy(),
              1e-12 * mises.plastic_work());
}



// Pure shear, which needs no rotation: after every step the stress is that of
// the law, and the shear strain is the plastic and the elastic one.
TEST(Viscoplastic, RemouldsAlongTheCurve)
{
  const double r = 0.2, xi_95 = 5.;
  for (const double K : {0., 30.})
    {
      Specimen<2>  soil("Bingham",
                       stiff_soil.parameters(
                         lines({{"Viscosity", K},
                                 {"Remoulded strength ratio", r},
                                 {"Plastic shear strain to remould", xi_95}})));
      const double dgamma = 0.01;
      double       gamma  = 0.;
      for (unsigned int step = 0; step < 1500; ++step)
        {
          const double before = plastic_shear_strain(soil);
          soil.step(pure_shear(0.5 * dgamma));
          gamma += dgamma;
          const double xi  = plastic_shear_strain(soil);
          const double s   = s_u * (r + (1. - r) * std::exp(-3. * xi / xi_95));
          const double tau = s + K * (xi - before) / soil.dt;
          EXPECT_NEAR(shear_stress(soil), tau, 1e-10 * s_u);
          EXPECT_NEAR(xi, gamma - tau / stiff_soil.mu, 1e-11);
          if (std::abs(gamma - xi_95) < 1e-9 && K == 0.)
            {
              EXPECT_NEAR(tau / s_u, r + (1. - r) * 0.05, 2e-4);
            }
        }
      EXPECT_NEAR(shear_stress(soil),
                  r * s_u + K / soil.dt * dgamma,
                  s_u * 2e-4);
    }
}



// Pure shear, in closed form for n = 1 without remoulding: from yield on,
// tau - s_u - K rate falls by 1 + G dt/K in each step. Work is trapezoidal.
TEST(Viscoplastic, WorkIsStoredOrDissipated)
{
  const Elastic clay{250e3, 0.49};
  const double  K = 2e3, rate = 4.;
  Specimen<2>   soil("Bingham", clay.parameters(lines({{"Viscosity", K}})));
  const double  d = rate * soil.dt, ratio = clay.mu * soil.dt / K;
  double        tau = 0., plastic_work = 0.;
  for (unsigned int step = 0; step < 200; ++step)
    {
      soil.step(pure_shear(0.5 * d));
      const double trial = tau + clay.mu * d;
      const double after =
        trial <= s_u ? trial : (trial + ratio * s_u) / (1. + ratio);
      plastic_work +=
        0.5 * (tau + after) * (trial - after) / clay.mu * soil.volume;
      tau = after;
      EXPECT_NEAR(shear_stress(soil), tau, 1e-11 * s_u);
      EXPECT_NEAR(soil.plastic_work(), plastic_work, 1e-11 * s_u);
      EXPECT_NEAR(soil.elastic_energy(),
                  soil.volume * tau * tau / (2. * clay.mu),
                  1e-11 * s_u);
    }
  EXPECT_NEAR(tau, s_u + K * rate, 1e-9 * s_u);
}



// With remoulding and n < 1: what is done from outside is stored or dissipated.
TEST(Viscoplastic, WorkInRemouldingShear)
{
  const Elastic clay{250e3, 0.49};
  Specimen<2>   soil("Herschel-Bulkley",
                   clay.parameters(herschel_bulkley(300., 0.5, 0.3)));
  double        work = 0.;
  for (unsigned int step = 0; step < 3000; ++step)
    {
      const double before = soil.stress()[3];
      soil.step(simple_shear<2>(1e-3));
      work += 0.5 * (before + soil.stress()[3]) * 1e-3 * soil.volume;
    }
  EXPECT_GT(soil.plastic_work(), 0.9 * work);
  EXPECT_NEAR(soil.elastic_energy() + soil.plastic_work(), work, 1e-6 * work);
  EXPECT_NEAR(soil.elastic_energy(),
              soil.volume * soil.deviator_squared() / (4. * clay.mu),
              1e-11 * work);
}



TEST(Viscoplastic, BatchEqualsPointByPointWithRemoulding)
{
  constexpr unsigned int n = 19;
  const Elastic          clay{250e3, 0.49};
  for (const double exponent : {0.4, 1., 2.})
    {
      Specimen<2>  batch("Herschel-Bulkley",
                        clay.parameters(herschel_bulkley(100., exponent, 0.2)),
                        n);
      Specimen<2>  single("Herschel-Bulkley",
                         clay.parameters(herschel_bulkley(100., exponent, 0.2)),
                         n);
      std::mt19937 random(5);
      for (unsigned int step = 0; step < 20; ++step)
        {
          for (unsigned int p = 0; p < n; ++p)
            {
              const auto H = random_matrix<2>(random, p % 3 == 0 ? 1e-4 : 0.02);
              batch.set_increment(H, p);
              single.step(H, p);
            }
          batch.law->update_stress(
            batch.points, batch.workspace, 0, n, batch.dt);
        }
      EXPECT_GT(plastic_shear_strain(batch, 1), 0.01);
      for (unsigned int p = 0; p < n; ++p)
        {
          expect_near(batch.stress(p), single.stress(p), 1e-13 * clay.bulk);
          EXPECT_NEAR(plastic_shear_strain(batch, p),
                      plastic_shear_strain(single, p),
                      1e-13);
        }
    }
}



TEST(Viscoplastic, ContradictionsAreRefused)
{
  EXPECT_NE(error("Herschel-Bulkley", "set Flow exponent = 0")
              .find("Give a positive number"),
            std::string::npos);
  // 3 s_u (1 - r)/G = 3 * 2500 * 0.5/1e5, and 1 % more.
  const std::string soft =
    "set Young's modulus = 2.5e5\nset Poisson's ratio = 0.25\n"
    "set Remoulded strength ratio = 0.5\n"
    "set Plastic shear strain to remould = ";
  for (const std::string name : {"Bingham", "Herschel-Bulkley"})
    {
      EXPECT_NE(error(name, soft + "0.0378").find("more than 0.037878"),
                std::string::npos);
      EXPECT_EQ(error(name, soft + "0.0379"), "");
    }
  EXPECT_THROW(make_law<2>("Bingham", "set Consistency = 1"),
               dealii::ExceptionBase);
  EXPECT_THROW(make_law<2>("Herschel-Bulkley",
                           "set Remoulded strength ratio = 1.1"),
               dealii::ExceptionBase);
}



// Both numbers are proportional to the cell size; the integral of
// s_u(xi) - r s_u0 is (1 - r) s_u0 xi_95/3 = 0.8 * 2500 * 5/3, of the line
// 3 (s_u - s_res)^2/(2 |H|) = 3 * 1500^2/(2 * 5000), at a strain of 0.9.
TEST(Viscoplastic, SofteningIsNoted)
{
  const std::string remoulding =
    lines({{"Remoulded strength ratio", 0.2},
           {"Plastic shear strain to remould", 5.}});
  const std::string softening =
    lines({{"Hardening modulus", -5000.},
           {"Residual undrained shear strength", 1000.}});
  const auto check = [](const std::string              &name,
                        const std::string              &parameters,
                        const std::vector<std::string> &parts) {
    const std::string note = make_law<2>(name, parameters)->note(0.4).sentence;
    for (const std::string &part : parts)
      EXPECT_NE(note.find(part), std::string::npos) << part << '\n' << note;
  };
  check("Bingham",
        remoulding,
        {"2 m and 1333.33 J/m^2 on cells of 0.4 m",
         "1 m and 666.667 J/m^2 on cells of 0.2 m",
         "95 %",
         "at 2 m, unless `Viscosity`"});
  check("Herschel-Bulkley",
        remoulding + "set Consistency = 0",
        {"at 2 m, or set `Consistency` to more than 0"});
  check("von Mises",
        softening,
        {"0.36 m and 270 J/m^2 on cells of 0.4 m",
         "0.18 m and 135 J/m^2 on cells of 0.2 m",
         "at -12500 Pa/m, or take"});
  EXPECT_EQ(make_law<2>("Bingham", "")->note(0.4).sentence, "");
  EXPECT_EQ(make_law<2>("von Mises", "")->note(0.4).sentence, "");
  EXPECT_EQ(
    make_law<2>("von Mises", "set Hardening modulus = 1e3")->note(0.4).sentence,
    "");
  EXPECT_EQ(make_law<2>("linear elastic", "")->note(0.4).sentence, "");
}
