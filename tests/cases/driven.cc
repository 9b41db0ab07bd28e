// Soil that is driven by velocities and tractions on the faces of the mesh, and
// soil that damping brings to rest, against closed forms.

#include "case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// The stress of a point, Pa.
  struct StressOf
  {
    double xx, yy, zz, xy;

    StressOf(const Points<2> &points, const unsigned int p)
      : xx(points.data(points.stress, 0)[p])
      , yy(points.data(points.stress, 1)[p])
      , zz(points.data(points.stress, 2)[p])
      , xy(points.data(points.stress, 3)[p])
    {}

    double
    distance(const double x,
             const double y,
             const double z,
             const double s) const
    {
      return std::max({std::abs(xx - x),
                       std::abs(yy - y),
                       std::abs(zz - z),
                       std::abs(xy - s)});
    }
  };



  template <typename Action>
  void
  for_points(Case<2> &simulation, const Action &action)
  {
    for (unsigned int p = 0; p < simulation.points().size(); ++p)
      action(p);
  }



  void
  advance_to(Case<2> &simulation, const double time)
  {
    while (simulation->snapshot().time < time - 1e-12)
      simulation->advance();
  }



  /// One column of a point.
  double
  value(Case<2> &simulation, const unsigned int column, const unsigned int p)
  {
    return simulation.points().data(column)[p];
  }
} // namespace



TEST(Driven, SimpleShear)
{
  constexpr double G = 250e3 / 2.98, s_u = 2.5e3, gdot = 0.01;
  Case<2>          shear("verification/simple-shear.prm", {});
  const double     gamma_yield   = 2. * std::asin(0.5 * s_u / G);
  double           elastic_error = 0, plateau_error = 0, yielded_at = 0;
  while (shear->snapshot().time < 10. - 1e-12)
    {
      shear->advance();
      const double   gamma = gdot * shear->snapshot().time;
      const StressOf s(shear.points(), 0);
      if (gamma < gamma_yield - 1e-5)
        elastic_error = std::max(elastic_error,
                                 s.distance(G * (1. - std::cos(gamma)),
                                            -G * (1. - std::cos(gamma)),
                                            0.,
                                            G * std::sin(gamma)) /
                                   s_u);
      else if (gamma > gamma_yield + 1e-5)
        plateau_error =
          std::max(plateau_error, std::abs(std::hypot(s.xy, s.xx) - s_u) / s_u);
      if (yielded_at == 0 &&
          shear.points().data(shear.points().plastic_work)[0] > 0)
        yielded_at = gamma;
    }
  // The steady state lies within exp(-(gamma - gamma_yield) G/s_u).
  const StressOf last(shear.points(), 0);
  const double   steady = s_u * std::sqrt(1. - std::pow(s_u / G, 2));
  std::cout << "simple shear: error before yield " << elastic_error
            << " s_u, of the radius after yield " << plateau_error
            << " s_u; yields at gamma = " << yielded_at << ", exact "
            << gamma_yield << "; tau at the end " << last.xy / s_u
            << " s_u, exact " << steady / s_u << '\n';
  EXPECT_LT(elastic_error, 1e-10);
  EXPECT_LT(plateau_error, 1e-10);
  EXPECT_NEAR(yielded_at, gamma_yield, 1.01e-5);
  EXPECT_NEAR(last.xy, steady, 1e-4 * s_u);
  for_points(shear, [&](const unsigned int p) {
    EXPECT_LT(
      StressOf(shear.points(), p).distance(last.xx, last.yy, last.zz, last.xy),
      1e-8 * s_u);
  });
}



TEST(Driven, PlaneStrainCompression)
{
  Case<2>      sample("verification/plane-strain-compression.prm", {});
  const double first_yield = 2500. * std::sqrt(3. / (1. - 0.49 + 0.49 * 0.49));
  double       before = 0, at = 0, elastic_error = 0;
  while (sample->snapshot().time < 200. - 1e-12)
    {
      sample->advance();
      const double t  = sample->snapshot().time;
      const double yy = -StressOf(sample.points(), 0).yy;
      const bool   has_yielded =
        sample.points().data(sample.points().plastic_work)[0] > 0;
      if (at == 0 && has_yielded)
        at = yy;
      if (!has_yielded)
        {
          before = yy;
          if (t < 20.) // until the start has died away
            continue;
          const double exact = 250e3 / (1. - 0.49 * 0.49) * 2e-4 * t;
          elastic_error = std::max(elastic_error, std::abs(yy - exact) / 5e3);
        }
    }
  const StressOf last(sample.points(), 0);
  std::cout << "plane-strain compression: elastic error " << elastic_error
            << ", first yield between " << before << " and " << at
            << " Pa, exact " << first_yield << "; plateau " << -last.yy
            << " Pa, s_zz " << -last.zz << " Pa, s_xx " << -last.xx << " Pa\n";
  EXPECT_LT(elastic_error, 1e-5);
  EXPECT_LT(before, first_yield + 0.01);
  EXPECT_NEAR(at, first_yield, 0.5);
  EXPECT_NEAR(-last.yy, 5000., 0.05);
  EXPECT_NEAR(-last.zz, 2500., 10.);
}



namespace
{
  /// Largest error over one turn in steps of a quarter, Pa.
  double
  turn(const Overrides &overrides)
  {
    Case<2> block("verification/rigid-rotation.prm", overrides);
    double  error = 0;
    for (unsigned int quarter = 1; quarter <= 4; ++quarter)
      {
        advance_to(block, 25. * quarter);
        const bool swapped = (quarter % 2 == 1);
        for_points(block, [&](const unsigned int p) {
          error = std::max(error,
                           StressOf(block.points(), p)
                             .distance(swapped ? -5e3 : -20e3,
                                       swapped ? -20e3 : -5e3,
                                       -8e3,
                                       swapped ? -3e3 : 3e3));
        });
      }
    return error;
  }
} // namespace



TEST(Driven, RigidRotation)
{
  const double tangent = turn({});
  // The velocity whose step ends where the rotation does.
  const std::string v     = "a*(x-xc)-b*(y-yc); b*(x-xc)+a*(y-yc)";
  Overrides         chord = {"Constants=w=2*pi/100; xc=0.5; yc=0.5; d=5e-3; "
                                     "a=(cos(w*d)-1)/d; b=sin(w*d)/d"};
  for (const std::string face : {"Left", "Right", "Bottom", "Top"})
    chord.push_back("Boundaries/" + face + " velocity=" + v);
  const double exact = turn(chord);
  std::cout << "rigid rotation: error " << tangent
            << " Pa, with the chord of the step " << exact << " Pa\n";
  EXPECT_NEAR(tangent, 1e4 * 2. * M_PI * M_PI / 20000, 0.01);
  EXPECT_LT(exact, 20e3 * 1e-10);
}



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
  while (bar->snapshot().time < 40. - 1e-12)
    {
      bar->advance();
      EXPECT_GE(bar->snapshot().boundary_work.damping, last_work);
      last_work = bar->snapshot().boundary_work.damping;
    }
  const auto &points = bar.points();
  double      stress = 0, stretch = 0;
  for_points(bar, [&](const unsigned int p) {
    // The last points lie beyond the mesh in part, where nothing stretches.
    if (value(bar, points.initial_position, p) > 9.5)
      return;
    const double F = points.data(points.deformation_gradient, 0)[p];
    stretch        = std::max(stretch, std::abs(std::log(F) / 1e-3 - 1.));
    stress = std::max(stress, std::abs(StressOf(points, p).xx / 100. - 1.));
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
  while (column->snapshot().time < 20. - 1e-12)
    {
      const double impulse = column->snapshot().boundary_work.wall_impulse[1];
      column->advance();
      const auto &now = column->snapshot();
      most_energy     = std::max(most_energy, now.nodes.kinetic_energy());
      EXPECT_GE(now.boundary_work.damping, last_work);
      last_work = now.boundary_work.damping;
      // At rest the rollers bear the whole weight, though there is damping.
      if (now.time > 19.)
        {
          EXPECT_NEAR((now.boundary_work.wall_impulse[1] - impulse) /
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
  const double at_rest = column->snapshot().nodes.kinetic_energy();
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
  while (column->snapshot().time < 20. - 1e-12)
    {
      column->advance();
      const double energy = column->snapshot().nodes.kinetic_energy();
      most                = std::max(most, energy);
      if (column->snapshot().time > 19.)
        late = std::max(late, energy);
    }
  EXPECT_EQ(column->snapshot().boundary_work.damping, 0.);
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
