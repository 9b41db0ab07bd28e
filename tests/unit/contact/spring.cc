// SPDX-License-Identifier: LGPL-2.1-or-later
// Springs of bodies: steps of any length balance to round-off.

#include <talus/contact/spring.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace talus;

namespace spring_test
{
  constexpr double infinite = std::numeric_limits<double>::infinity();



  /// Expect energies and momentum of @p n_steps steps with random impulses to
  /// balance. Return the energy lost, J.
  double
  expect_balance(Spring spring, const double mass, const double dt)
  {
    std::mt19937                           rng(7);
    std::uniform_real_distribution<double> random(-1., 1.);
    double                                 v = 0, lost = 0, work = 0, scale = 1;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double impulse = 50. * random(rng) * dt;
        const double after   = spring.velocity_after(mass, v, impulse, dt);
        const Spring::Resistance resistance = spring.resistance(v, after, dt);
        const double             round_off =
          1e-13 * (mass * (std::abs(v) + std::abs(after)) +
                   1e3 * dt * dt * (std::abs(v) + std::abs(after)) + 1.);
        EXPECT_NEAR(mass * (after - v),
                    impulse - resistance.impulse,
                    round_off);
        work += impulse * 0.5 * (v + after);
        scale += std::abs(impulse * (v + after)) + mass * after * after;
        lost += spring.advance(v, after, dt);
        EXPECT_NEAR(spring.force() * dt, -resistance.impulse, round_off);
        v = after;
        EXPECT_NEAR(0.5 * mass * v * v + spring.stored_energy() + lost,
                    work,
                    1e-12 * scale);
      }
    return lost;
  }



  // The longest step is many periods long.
  TEST(Spring, WorksBalance)
  {
    for (const double dt : {0.01, 0.3, 20.})
      {
        EXPECT_EQ(expect_balance({40., 0., infinite}, 2., dt), 0.);
        EXPECT_GT(expect_balance({40., 3., infinite}, 2., dt), 0.1);
        EXPECT_GT(expect_balance({40., 0., 5.}, 2., dt), 0.1);
        EXPECT_GT(expect_balance({40., 3., 5.}, 2., dt), 0.1);
        EXPECT_EQ(expect_balance({0., 0., infinite}, 2., dt), 0.);
      }
  }



  TEST(Spring, ForceIsLimited)
  {
    Spring spring(100., 0., 7.);
    // To an elongation of 1 m and back to 0.
    spring.advance(2., 0., 1.);
    EXPECT_NEAR(spring.stored_energy(), 0.5 * 7. * 0.07, 1e-12);
    EXPECT_NEAR(spring.slip(), 0.93, 1e-12);
    EXPECT_EQ(spring.force(), -3.5); // mean of 0 and 7 N
    spring.advance(0., -2., 1.);
    EXPECT_NEAR(spring.slip(), 0.07, 1e-12);
    EXPECT_NEAR(spring.force(), 0., 1e-12);
  }



  TEST(Spring, SlopeOfTheResistance)
  {
    const Spring     spring(100., 3., 7.);
    constexpr double dt = 0.1, step = 1e-6;
    for (const double v : {0.3, -0.4, 5., -6.})
      {
        const double slope = (spring.resistance(0.1, v + step, dt).impulse -
                              spring.resistance(0.1, v - step, dt).impulse) /
                             (2 * step);
        EXPECT_NEAR(spring.resistance(0.1, v, dt).slope, slope, 1e-8);
      }
  }
} // namespace spring_test
