// SPDX-License-Identifier: LGPL-2.1-or-later
// Rate laws at one point.

#include "specimen.h"

using namespace talus;

namespace
{
  const double sigma_y = std::sqrt(3.) * s_u;

  const std::string strength = "set Undrained shear strength = 2500\n";



  // The discrete stress is known in closed form: with tan(a/2) = dgamma/4 the
  // complex number (sxx - syy)/2 + i sxy turns by -a, gains i mu dgamma, and
  // turns by -a again. It tends to mu sin(gamma), the Jaumann rate's answer.
  template <int dim>
  void
  check_simple_shear()
  {
    Specimen<dim>      soil("linear elastic", paper.parameters());
    const double       dgamma = 0.02;
    const unsigned int n      = 100;
    for (unsigned int step = 0; step < n; ++step)
      soil.step(simple_shear<dim>(dgamma));

    const double a      = 2. * std::atan(dgamma / 4.);
    const double radius = paper.mu * (1. + dgamma * dgamma / 16.);
    const auto   sigma  = soil.stress();
    EXPECT_NEAR(sigma[3], radius * std::sin(2. * n * a), 1e-11 * paper.mu);
    EXPECT_NEAR(sigma[0],
                radius * (1. - std::cos(2. * n * a)),
                1e-11 * paper.mu);
    EXPECT_NEAR(sigma[1], -sigma[0], 1e-11 * paper.mu);
    EXPECT_NEAR(sigma[2], 0., 1e-11 * paper.mu);
    EXPECT_NEAR(sigma[3], paper.mu * std::sin(n * dgamma), 1e-4 * paper.mu);
    EXPECT_NEAR(soil.elastic_energy(),
                soil.volume * soil.deviator_squared() / (4. * paper.mu),
                1e-11 * paper.mu);
  }



  template <int dim>
  void
  check_rigid_rotation(const std::string &name, const unsigned int n_steps)
  {
    // Compressible: the round-off of det(I + dt L') comes times K.
    Specimen<dim>       soil(name, Elastic{250e3, 0.3}.parameters());
    Stress<dim, double> start;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      soil.points.data(soil.points.stress, c)[0] = start[c] =
        300. * std::cos(1. + 2. * c);
    const double m  = soil.mean_stress();
    const double ss = soil.deviator_squared();

    const double angle = 2. * pi / n_steps;
    const auto   H = add(rotation<dim>(angle), identity<dim, double>(), -1.);
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        soil.step(H);
        expect_near(soil.stress(),
                    rotated(rotation<dim>(step * angle), start),
                    300. * 1e-10);
        EXPECT_NEAR(soil.mean_stress(), m, 300. * 1e-10);
        EXPECT_NEAR(soil.deviator_squared(), ss, ss * 1e-11);
      }
    expect_near(soil.stress(), start, 300. * 1e-10);
    EXPECT_NEAR(soil.elastic_energy(), 0., 1e-9);
    EXPECT_EQ(soil.plastic_work(), 0.);
  }



  // Mean stress against volume on a random path, with steps so large that
  // ln det(I + dt L') leaves its series.
  template <int dim>
  void
  check_pressure(const std::string &name)
  {
    std::mt19937  random(1);
    Specimen<dim> soil(name, paper.parameters());
    for (unsigned int step = 0; step < 5000; ++step)
      soil.step(random_matrix<dim>(random, step % 50 == 0 ? 0.05 : 2e-3));
    const double log_J = std::log(determinant(soil.F()));
    EXPECT_GT(std::abs(log_J), 0.01);
    EXPECT_NEAR(soil.mean_stress(), paper.bulk * log_J, 2e-13 * paper.bulk);
  }



  // Pure shear in steps that cross yield and kink anywhere: equivalent plastic
  // strain and stress do not depend on the steps.
  void
  check_hardening(const double       hardening,
                  const double       residual,
                  const unsigned int n_steps)
  {
    std::ostringstream more;
    more << strength << "set Hardening modulus = " << hardening
         << "\nset Residual undrained shear strength = " << residual;
    Specimen<2> soil("von Mises", paper.parameters(more.str()));

    const double g_end = 5. * s_u / (2. * paper.mu);
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        soil.step(pure_shear(g_end / n_steps));
        const double q_elastic =
          2. * std::sqrt(3.) * paper.mu * g_end * step / n_steps;
        const double q_residual = std::sqrt(3.) * residual;
        double       ep         = 0.;
        if (q_elastic > sigma_y)
          ep = (q_elastic - sigma_y) / (3. * paper.mu + hardening);
        if (ep > 0. && sigma_y + hardening * ep < q_residual)
          ep = (q_elastic - q_residual) / (3. * paper.mu);
        const double q = q_elastic - 3. * paper.mu * ep;
        EXPECT_NEAR(soil.plastic_strain(), ep, 1e-13);
        EXPECT_NEAR(std::sqrt(1.5 * soil.deviator_squared()),
                    q,
                    1e-11 * sigma_y);
        EXPECT_NEAR(soil.elastic_energy(),
                    soil.volume * q * q / (6. * paper.mu),
                    1e-11 * soil.volume * sigma_y);
      }
  }



  /// Advance a point in plane-strain compression by the axial strain -strain,
  /// with the lateral strain that leaves sigma_xx = 0.
  void
  compress(Specimen<2> &soil, const double strain)
  {
    // Try on point 1, secant method.
    const auto lateral_stress = [&](const double lateral) {
      soil.points.copy(0, 1);
      soil.step({{{{{lateral, 0.}}, {{0., -strain}}}}}, 1);
      return soil.stress(1)[0];
    };
    double x0 = 0., x1 = strain;
    double f0 = lateral_stress(x0), f1 = lateral_stress(x1);
    for (unsigned int i = 0; i < 50 && std::abs(f1) > 1e-9; ++i)
      {
        const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
        x0 = x1, f0 = f1;
        x1 = x2, f1 = lateral_stress(x2);
      }
    ASSERT_LT(std::abs(f1), 1e-8);
    soil.points.copy(1, 0);
  }
} // namespace



TEST(RateLaws, SimpleShearIsElastic)
{
  check_simple_shear<2>();
  check_simple_shear<3>();
}



TEST(RateLaws, StressTurnsWithARigidBody)
{
  for (const std::string name : {"linear elastic", "von Mises", "Bingham"})
    for (const unsigned int n_steps : {5, 360})
      {
        check_rigid_rotation<2>(name, n_steps);
        check_rigid_rotation<3>(name, n_steps);
      }
}



TEST(RateLaws, PressureFollowsTheVolume)
{
  for (const std::string name : {"linear elastic", "von Mises", "Bingham"})
    {
      check_pressure<2>(name);
      check_pressure<3>(name);
    }
}



// The integral of K ln J dV, V0 K (J ln J - J + 1), and the error of the
// trapezoidal rule, h^2/12 times the change of d(J ln J)/d(ln J).
TEST(RateLaws, VolumetricWorkIsStored)
{
  for (const double strain : {1e-3, 5e-4})
    {
      Specimen<3> soil("linear elastic", paper.parameters());
      auto        H = identity<3, double>();
      for (unsigned int i = 0; i < 3; ++i)
        H[i][i] = -strain;
      for (unsigned int step = 0; step < 0.1 / strain; ++step)
        soil.step(H);
      const double J     = determinant(soil.F());
      const double h     = 3. * std::log(1. - strain);
      const double slope = (1. + std::log(J)) * J - 1.;
      EXPECT_NEAR(soil.elastic_energy() / soil.volume / paper.bulk,
                  J * std::log(J) - J + 1. + h * h / 12. * slope,
                  1e-11);
    }
}



// A stiff clay, so that the Jaumann rate's normal stresses do not show.
TEST(VonMises, YieldsInSimpleShear)
{
  const Elastic stiff{2.5e9, 0.49};
  const double  yield_strain = s_u / stiff.mu;
  Specimen<3>   soil("von Mises", stiff.parameters(strength));
  for (unsigned int step = 1; step <= 3000; ++step)
    {
      soil.step(simple_shear<3>(yield_strain / 1000.));
      const double gamma = step / 1000. * yield_strain;
      EXPECT_NEAR(soil.stress()[3],
                  std::min(stiff.mu * gamma, s_u),
                  1e-10 * s_u);
      if (step <= 999)
        EXPECT_EQ(soil.plastic_strain(), 0.);
      else
        EXPECT_NEAR(soil.plastic_strain(),
                    (gamma - yield_strain) / std::sqrt(3.),
                    1e-10 * yield_strain);
    }
}



// The clay of the paper. In steady shear the Jaumann rate leaves a normal
// stress, tau = s_u cos(delta) with sin(delta) = s_u/mu; in steps, with a as in
// check_simple_shear(), the return ends at sin(delta) = s_u sin(2a)/(mu dgamma)
// and the second half of the rotation adds a.
TEST(VonMises, SteadyShear)
{
  const double dgamma = 1e-3;
  Specimen<2>  soil("von Mises", paper.parameters(strength));
  double       work = 0.;
  for (unsigned int step = 0; step < 2000; ++step)
    {
      const double tau = soil.stress()[3];
      soil.step(simple_shear<2>(dgamma));
      work += 0.5 * (tau + soil.stress()[3]) * dgamma * soil.volume;
    }
  const double a = 2. * std::atan(dgamma / 4.);
  const double delta =
    std::asin(s_u * std::sin(2. * a) / (paper.mu * dgamma)) + a;
  EXPECT_NEAR(std::sin(delta), s_u / paper.mu, dgamma);
  EXPECT_NEAR(soil.stress()[3], s_u * std::cos(delta), 1e-11 * s_u);
  EXPECT_NEAR(soil.stress()[0], s_u * std::sin(delta), 1e-11 * s_u);
  EXPECT_NEAR(std::sqrt(1.5 * soil.deviator_squared()),
              sigma_y,
              1e-12 * sigma_y);
  // The work done from outside is stored or dissipated.
  EXPECT_NEAR(soil.elastic_energy() + soil.plastic_work(), work, 1e-6 * work);
  EXPECT_NEAR(soil.elastic_energy(),
              soil.volume * soil.deviator_squared() / (4. * paper.mu),
              1e-11 * work);
}



TEST(VonMises, PlaneStrainCompression)
{
  Specimen<2> soil("von Mises", paper.parameters(strength), 3);
  // Elastic: sigma_zz = nu sigma_yy.
  const double first_yield =
    sigma_y / std::sqrt(1. - paper.nu + paper.nu * paper.nu);
  const double yield_strain =
    first_yield * (1. - paper.nu * paper.nu) / paper.E;
  for (unsigned int step = 0; step < 995; ++step)
    compress(soil, yield_strain / 1000.);
  ASSERT_EQ(soil.plastic_strain(), 0.);

  // Bisect the last step for the onset of plastic flow.
  soil.points.copy(0, 2);
  double lower = 0., upper = yield_strain / 50.;
  for (unsigned int i = 0; i < 40; ++i)
    {
      soil.points.copy(2, 0);
      const double middle = 0.5 * (lower + upper);
      compress(soil, middle);
      (soil.plastic_strain() > 0. ? upper : lower) = middle;
    }
  EXPECT_NEAR(-soil.stress()[1], first_yield, 1e-6 * first_yield);
  EXPECT_NEAR(-soil.stress()[1], 4999.67, 0.01);

  for (unsigned int step = 0; step < 2000; ++step)
    compress(soil, yield_strain / 100.);
  EXPECT_NEAR(-soil.stress()[1], 2. * s_u, 1e-9 * s_u);
}



TEST(VonMises, HardensAndSoftens)
{
  for (const unsigned int n_steps : {1, 7, 100})
    {
      check_hardening(0., 0., n_steps);
      check_hardening(0., s_u, n_steps);
      check_hardening(0.3 * paper.E, 0., n_steps);
      check_hardening(-0.1 * paper.E, 0.4 * s_u, n_steps);
      check_hardening(-0.9 * paper.E, 0.4 * s_u, n_steps);
    }
}



// Loading, plastic flow with hardening, unloading: yield falls on the end of a
// step, so that the trapezoidal rule is exact.
TEST(VonMises, PlasticWork)
{
  const double hardening = 50e3;
  Specimen<2>  soil("von Mises",
                   paper.parameters(strength + "set Hardening modulus = 50e3"));
  const double g = s_u / (2. * paper.mu) / 100.;
  for (unsigned int step = 0; step < 300; ++step)
    soil.step(pure_shear(g));
  for (unsigned int step = 0; step < 50; ++step)
    soil.step(pure_shear(-g));
  const double ep =
    200. * g * 2. * std::sqrt(3.) * paper.mu / (3. * paper.mu + hardening);
  EXPECT_NEAR(soil.plastic_strain(), ep, 1e-12);
  EXPECT_NEAR(soil.plastic_work(),
              soil.volume * (sigma_y * ep + 0.5 * hardening * ep * ep),
              1e-10 * soil.plastic_work());
}
