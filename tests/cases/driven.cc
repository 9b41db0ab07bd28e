// SPDX-License-Identifier: LGPL-2.1-or-later
// Soil that is driven by velocities and tractions on the faces of the mesh, and
// soil that damping brings to rest, against closed forms.

#include "driven.h"
#include "case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// Root mean square of the error in the displacement at the end, relative to
  /// the displacement behind the wave, A T/2.
  double
  error_of_wave(const unsigned int cells_per_meter)
  {
    const std::string h = text(1. / cells_per_meter);
    Case<2>           bar("driven-bar.prm",
                {"Grid/Cell size=" + h,
                           "Grid/Upper corner=10," + h,
                           "Bodies/bar/Upper corner=10," + h});
    advance_to(bar, 0.6);
    const auto &points = bar.points();
    double      sum    = 0;
    for_points(bar, [&](const unsigned int p) {
      const double X   = value(bar, points.initial_position, p);
      const double tau = std::min(0.4, std::max(0., 0.6 - X / 10.));
      const double exact =
        1e-3 * (0.5 * tau - 0.1 / M_PI * std::sin(M_PI * tau / 0.2));
      const double u = value(bar, points.position, p) - X;
      sum += std::pow(u - exact, 2) / points.size();
    });
    return std::sqrt(sum) / 2e-4;
  }
} // namespace



TEST(Driven, WaveInABar)
{
  std::vector<double> errors;
  for (const unsigned int n : {4, 8, 16})
    errors.push_back(error_of_wave(n));
  std::cout << "driven bar: errors " << errors[0] << ' ' << errors[1] << ' '
            << errors[2] << ", orders " << std::log2(errors[0] / errors[1])
            << ' ' << std::log2(errors[1] / errors[2]) << '\n';
  EXPECT_LT(errors[2], 1e-3);
  // Taken a half step too early the velocity would be of first order.
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.8);
}



TEST(Driven, EnergyOfTheWave)
{
  // Before the wave is reflected the piston gives E = rho c A^2 integral f^2.
  const Table  table    = run<2>("driven-bar.prm", "driven-bar");
  const double exact    = 1000. * 10. * 1e-6 * 0.375 * 0.4 * 0.25;
  const double given    = -table["contact work [J]"].back();
  const double leftover = table["energy remainder [J]"].back();
  std::cout << "driven bar: the wall gives " << given << " J/m, exact " << exact
            << ", remainder " << leftover << '\n';
  EXPECT_NEAR(given, exact, 0.01 * exact);
  EXPECT_LT(std::abs(leftover), 0.01 * exact);
}



TEST(Driven, SlowBarIsStatic)
{
  // Drawn out at its left end; the velocity gradient is uniform in space.
  Case<2> bar("driven-bar.prm",
              {"End time=20",
               "Boundaries/Left velocity=if(t<10, -1e-4*sin(pi*t/10)^2, 0); "
               "free",
               "Damping/Local damping=0.5",
               "Output/Runout=false"});
  advance_to(bar, 20.);
  const double exact = 1e5 * 5e-4 / 10.;
  double       error = 0;
  for_points(bar, [&](const unsigned int p) {
    // The first points lie beyond the mesh in part, where nothing stretches.
    if (value(bar, bar.points().initial_position, p) > 0.5)
      error =
        std::max(error, std::abs(StressOf(bar.points(), p).xx / exact - 1.));
  });
  std::cout << "slow bar: relative error of the stress " << error << '\n';
  // Of the order of the strain, 5e-5, since the end leaves the mesh.
  EXPECT_LT(error, 5e-5);
}



TEST(Driven, TractionStretchesABar)
{
  // nu = 0: s_xx = E ln(lambda) = the traction.
  Case<2> bar("driven-bar.prm",
              {"End time=40",
               "Boundaries/Left=roller",
               "Boundaries/Left velocity=",
               "Boundaries/Right=traction",
               "Boundaries/Right traction=100*0.5*(1-cos(pi*min(t/10, 1))); 0",
               "Damping/Local damping=0.5",
               "Output/Runout=false"});
  double  last_work = 0;
  while (bar->state().time < 40. - 1e-12)
    {
      bar->advance();
      EXPECT_GE(bar->state().accounts.energy("damping work"), last_work);
      last_work = bar->state().accounts.energy("damping work");
    }
  const auto &points = bar.points();
  double      stress = 0, stretch = 0;
  for_points(bar, [&](const unsigned int p) {
    // The last points lie beyond the mesh in part, where nothing stretches.
    if (value(bar, points.initial_position, p) > 9.5)
      return;
    const double F =
      points.data(points.edges)[p] / points.data(points.length_at_creation)[p];
    stretch = std::max(stretch, std::abs(std::log(F) / 1e-3 - 1.));
    stress  = std::max(stress, std::abs(StressOf(points, p).xx / 100. - 1.));
  });
  std::cout << "bar under traction: relative error of the stretch " << stretch
            << ", of the stress " << stress << ", damping work " << last_work
            << " J/m\n";
  EXPECT_LT(stretch, 1e-4);
  EXPECT_LT(stress, 1e-4);
}



TEST(Damped, ColumnComesToRest)
{
  Case<2> column("column.prm", {});
  double  most_energy = 0, last_work = 0;
  while (column->state().time < 20. - 1e-12)
    {
      const double impulse =
        column->state().accounts.impulse("wall impulse")[1];
      column->advance();
      const auto &now = column->state();
      most_energy     = std::max(most_energy, now.nodes.kinetic_energy());
      EXPECT_GE(now.accounts.energy("damping work"), last_work);
      last_work = now.accounts.energy("damping work");
      // At rest the rollers bear the whole weight, though there is damping.
      if (now.time > 19.)
        {
          EXPECT_NEAR((now.accounts.impulse("wall impulse")[1] - impulse) /
                        now.time_step,
                      1000. * 10. * 10. * 0.5,
                      50.);
        }
    }
  const auto &points = column.points();
  double      error  = 0;
  for_points(column, [&](const unsigned int p) {
    const double depth = 10. - points.data(points.initial_position, 1)[p];
    error = std::max(error, std::abs(StressOf(points, p).yy + 1e4 * depth));
  });
  const double at_rest = column->state().nodes.kinetic_energy();
  std::cout << "column: kinetic energy of the grid " << at_rest
            << " J/m, at most " << most_energy << "; error of the stress "
            << error / 1e5 << " rho g H, damping work " << last_work
            << " J/m\n";
  EXPECT_LT(at_rest, 1e-6 * most_energy);
  // The strain hardly varies within a cell; points are h/4 off its centre.
  EXPECT_NEAR(error, 1e4 * 0.25 * 0.5, 100.);
}



// The control: without damping it rings for ever.
TEST(Damped, UndampedColumnRings)
{
  const Overrides undamped = {"Damping/Local damping=0", "Gravity/Ramp time=0"};
  Case<2>         column("column.prm", undamped);
  advance_to(column, 10.);
  double most = 0, late = 0;
  while (column->state().time < 20. - 1e-12)
    {
      column->advance();
      const double energy = column->state().nodes.kinetic_energy();
      most                = std::max(most, energy);
      if (column->state().time > 19.)
        late = std::max(late, energy);
    }
  EXPECT_EQ(column->state().accounts.energy("damping work"), 0.);
  EXPECT_GT(late, 0.5 * most);
}



TEST(Damped, BudgetClosesAndTheRunoutIsAbsent)
{
  const Table  table     = run<2>("column.prm", "column");
  const double gravity   = table["gravity work [J]"].back();
  const double remainder = table["energy remainder [J]"].back();
  std::cout << "column: gravity work " << gravity << " J/m, damping work "
            << table["damping work [J]"].back() << ", remainder " << remainder
            << '\n';
  EXPECT_LT(std::abs(remainder), 1e-3 * gravity);
  EXPECT_GT(table["damping work [J]"].back(), 0.);
  for (const std::string name :
       {"front x [m]", "front of 99.5 % mass x [m]", "rear x [m]"})
    EXPECT_THROW(table[name], std::runtime_error);
  const auto folder = std::filesystem::path(TALUS_RESULTS_DIR) / "column";
  EXPECT_FALSE(std::filesystem::exists(folder / "profile.csv"));
}
