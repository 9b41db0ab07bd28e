// SPDX-License-Identifier: LGPL-2.1-or-later
// Excess pore pressure given in place and time, in effective stress.

#include "static_case.h"

#include <talus/base/errors.h>
#include <talus/observers/pore_pressure_ratio.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double per_degree = M_PI / 180.;

  const std::string pore_column = "pore-column.prm";

  const double unit_weight = 2000. * 10.; // N/m^3
  const double oedometric_modulus =
    1e7 * 0.75 / 0.625; // of one-dimensional strain, Pa
  const double height_of_column = 5., r_u = 0.5; // m, -
} // namespace



// The total stress is that of the slope at rest: nothing moves, on cells with
// and without the mean of B-bar.
TEST(PorePressure, InfiniteSlopeAtRest)
{
  const std::string file = "verification/shear-layer.prm";
  for (const std::string mean : {"on", "off"})
    {
      Case<2>      layer(file,
                    {"Boundaries/Bottom=fixed",
                          "Bodies/layer/Initial stress=",
                          "Bodies/layer/K0=0.8",
                          "Materials/clay/Cell mean=" + mean,
                          "Excess pore pressure/Initial=0.6*overburden"});
      const auto  &points = layer.points();
      const double g_x    = 9.81 * std::sin(5. * per_degree);
      const double g_y    = -9.81 * std::cos(5. * per_degree);
      double       error  = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double mass =
            1500. * (2. - points.data(points.initial_position, 1)[p]);
          const double exact[4] = {0.32 * g_y * mass,
                                   0.4 * g_y * mass,
                                   0.32 * g_y * mass,
                                   g_x * mass};
          for (unsigned int c = 0; c < 4; ++c)
            error =
              std::max(error,
                       std::abs(points.data(points.stress, c)[p] - exact[c]));
        }
      while (layer->state().time < 1.)
        layer->advance();
      double energy = 0, mass = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          mass += points.data(points.mass)[p];
          energy += 0.5 * points.data(points.mass)[p] *
                    load_vector(points, points.velocity, p).norm_square();
        }
      Verification gates(
        "Infinite slope at rest, r_u = 0.6, cell mean " + mean,
        "prm/" + file + " with K0 = 0.8 on a fixed bottom",
        "s_yy = -(1 - r_u) rho g cos d, s_xy = rho g sin d, no "
        "motion");
      gates.at_most("effective stress, largest error / that at the bottom",
                    error / (1500. * 9.81 * 2.),
                    1e-13);
      gates.at_most("kinetic energy after 1 s / that of free fall",
                    energy / (0.5 * mass * 9.81 * 9.81),
                    1e-20);
    }
}



// In equilibrium the effective stress is the weight less the pressure.
TEST(PorePressure, ColumnInEquilibrium)
{
  const StaticCase<2> at_rest(pore_column,
                              "pore-column-equilibrium",
                              {"Stages=equilibrium",
                               "Bodies/column/K0=",
                               "Excess pore pressure/Final=",
                               "Excess pore pressure/Duration=0",
                               "Excess pore pressure/Initial=0.5*overburden"});
  const auto         &points = at_rest.points();
  // The strain of a cell is constant: the mean over its two points in y counts.
  constexpr double                     h = 0.25; // m
  std::map<int, std::array<double, 3>> cells;    // depth, s_yy, s_xx
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const double y    = points.data(points.initial_position, 1)[p];
      auto        &cell = cells[int(y / h)];
      cell[0] += (height_of_column - y) / 4.;
      cell[1] += points.data(points.stress, 1)[p] / 4.;
      cell[2] += points.data(points.stress, 0)[p] / 4.;
    }
  double error = 0;
  for (const auto &[number, cell] : cells)
    {
      // Two columns of cells.
      const double depth = 0.5 * cell[0], s_yy = 0.5 * cell[1];
      error =
        std::max(error, std::abs(s_yy + (1. - r_u) * unit_weight * depth));
      // Between smooth walls s_xx = nu/(1 - nu) s_yy, in effective stress.
      error = std::max(error, std::abs(0.5 * cell[2] - s_yy / 3.));
    }
  error /= unit_weight * height_of_column;
  Verification("Column with excess pore pressure in equilibrium",
               "tests/cases/" + pore_column,
               "s_yy = -(1 - r_u) gamma z, s_xx = nu/(1 - nu) s_yy")
    .at_most("effective stress, largest error / weight of the column",
             error,
             1e-9);
}



namespace
{
  // K_f/K for nu = 0.3 and nu_u = 0.49, and Skempton's B = K_f/(K_f + K).
  constexpr double water_over_soil = 21.9230769231, skempton = 0.9563758389;

  Overrides
  undrained(const Overrides &more)
  {
    return Overrides{"Materials/soil/Poisson's ratio=0.3",
                     "Materials/soil/Pore water/Drainage=undrained",
                     "Bodies/column/K0=",
                     "Excess pore pressure/Final=",
                     "Excess pore pressure/Duration=0"} +
           more;
  }
} // namespace



// Undrained soil carries its own weight, as it came, by the water.
TEST(PorePressure, UndrainedColumnInEquilibrium)
{
  const StaticCase<2> at_rest(pore_column,
                              "undrained-column",
                              undrained({"Stages=equilibrium"}));
  const auto         &points = at_rest.points();
  double              error  = 0;
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const double u    = points.data(points.pore_pressure())[p];
      double       mean = 0;
      for (unsigned int d = 0; d < 3; ++d)
        mean -= points.data(points.stress, d)[p] / 3.;
      error = std::max(error, std::abs(u / (u + mean) - skempton));
      // Between smooth walls the strain is in one direction: du = K_f/M dp'_yy.
      const double M_over_K = 3. * 0.7 / 1.3;
      error                 = std::max(error,
                       std::abs(-u / points.data(points.stress, 1)[p] *
                                  M_over_K / water_over_soil -
                                1.));
    }
  Verification("Undrained column in equilibrium",
               "tests/cases/" + pore_column + ", undrained",
               "B = K_f/(K_f + K)")
    .at_most("u/p - B, and u/s_yy over its value - 1, largest", error, 1e-9);
}



// Undrained elastic soil is elastic soil of the same shear modulus and nu_u:
// both swing alike under a weight that comes at once, and the energy closes
// alike.
TEST(PorePressure, UndrainedMovesAsOneMaterial)
{
  const Overrides at_once = {"Damping/Local damping=0",
                             "End time=1",
                             "Output/Statistics interval=0.02"};
  const Table     with_water =
    run<2>(pore_column, "undrained-swings", undrained(at_once));
  const Table total =
    run<2>(pore_column,
           "undrained-as-one",
           at_once + Overrides{"Materials/soil/Poisson's ratio=0.49",
                               text("Materials/soil/Young's modulus=",
                                    std::setprecision(15),
                                    1e7 * 1.49 / 1.3),
                               "Bodies/column/K0=",
                               "Excess pore pressure/Final=",
                               "Excess pore pressure/Duration=0"});
  const auto &y = total["centre y [m]"], &y_water = with_water["centre y [m]"];
  ASSERT_EQ(y.size(), y_water.size());
  double error = 0, amplitude = 0;
  for (unsigned int i = 0; i < y.size(); ++i)
    {
      error     = std::max(error, std::abs(y[i] - y_water[i]));
      amplitude = std::max(amplitude, std::abs(y[i] - y[0]));
    }
  Verification gates("Undrained column that swings",
                     "tests/cases/" + pore_column + ", undrained",
                     "soil with the shear modulus of the skeleton and nu_u");
  gates.at_most("height of the centre / amplitude, difference",
                error / amplitude,
                1e-3);
  // The remainder is that of one material: a wave that begins at once.
  const auto &rest       = total["energy remainder [J]"],
             &rest_water = with_water["energy remainder [J]"];
  double remainder       = 0;
  for (unsigned int i = 0; i < rest.size(); ++i)
    remainder = std::max(remainder, std::abs(rest_water[i] - rest[i]));
  const auto  &energy = with_water["water energy [J]"];
  const double stored = *std::max_element(energy.begin(), energy.end());
  EXPECT_GT(stored, 0.);
  gates.at_most("energy remainder / energy of the water, difference",
                remainder / stored,
                1e-3);
}



// The pressure rises slowly: the column swells as in equilibrium, and the work
// of the pressure, integral of u d(eps_v), is u^2/(2 M) per volume.
TEST(PorePressure, ColumnSwells)
{
  for (const std::string mean : {"on", "off"})
    {
      const std::string name = "pore-column-" + mean;
      const Table       table =
        run<2>(pore_column, name, {"Materials/soil/Cell mean=" + mean});
      Verification gates("Column with rising excess pore pressure, cell mean " +
                           mean,
                         "tests/cases/" + pore_column,
                         "swells by r gamma H^2/(2 M)");
      // The centre of mass rises by the integral of u_y(y)/H.
      const double swelling = r_u * unit_weight / oedometric_modulus *
                              (height_of_column * height_of_column / 3.);
      const double rise =
        table["centre y [m]"].back() - table["centre y [m]"].front();
      gates.near("rise of the centre of mass [m]", rise, swelling, 0.005);
      gates.near("work of the pore pressure [J]",
                 table["pore pressure work [J]"].back(),
                 0.5 * std::pow(r_u * unit_weight, 2) /
                   (6. * oedometric_modulus) * std::pow(height_of_column, 3),
                 0.01);
    }
}



namespace
{
  constexpr double mu = 0.5, slope_angle = 10. * per_degree;
  constexpr double ramp = 10.; // s



  /// Pore pressure ratio at time @p t, s.
  double
  ratio_at(const double t)
  {
    return 0.4 * (1. - std::cos(M_PI * t / ramp));
  }



  /// Velocity of a rigid slab at the end of the ramp, m/s: from the time on at
  /// which r_u = 1 - tan(10 degrees)/mu the acceleration is
  /// g mu cos (r_u - this).
  double
  velocity_of_slab()
  {
    const double critical = 1. - std::tan(slope_angle) / mu;
    const double begin    = ramp / M_PI * std::acos(1. - critical / 0.4);
    const double integral =
      0.4 * (ramp - begin) + 0.4 * ramp / M_PI * std::sin(M_PI * begin / ramp);
    return 9.81 * mu * std::cos(slope_angle) *
           (integral - critical * (ramp - begin));
  }



  /// A slab between periodic faces whose pore pressure ratio rises to 0.8.
  void
  expect_slab_to_slide(const std::string &name, const Overrides &overrides)
  {
    const std::string file = "verification/block-on-incline.prm";
    const Table       table =
      run<2>(file,
             "pore-slab-" + name,
             Overrides{"Gravity/Slope angle=10",
                       "End time=10",
                       "Grid/Lower corner=0,-0.5",
                       "Grid/Upper corner=1,2",
                       "Bodies/block/Upper corner=1,1",
                       "Bodies/block/K0=0.5",
                       "Boundaries/Left=periodic",
                       "Boundaries/Right=periodic",
                       "Excess pore pressure/Final=0.8*overburden",
                       text("Excess pore pressure/Duration=", ramp),
                       text("Boundaries/Seabed/Friction coefficient=", mu),
                       "Materials/stiff/Young's modulus=1e7",
                       "Output/Statistics interval=0.01",
                       "Output/Runout=false"} +
               overrides);
    Verification gates("Slab on 10 degrees, mu = 0.5, rising pressure, " + name,
                       "prm/" + file,
                       "slides from r_u = 1 - tan(10 degrees)/mu on");
    const auto  &time     = table["time [s]"];
    const auto  &velocity = table["centre velocity x [m/s]"];
    unsigned int begin    = 0;
    while (begin + 1 < velocity.size() && velocity[begin] < 1e-4)
      ++begin;
    gates.near("r_u when it moves at 0.1 mm/s",
               ratio_at(time[begin]),
               0.6473460386,
               0.01);
    gates.near("velocity at 10 s [m/s]",
               velocity.back(),
               velocity_of_slab(),
               0.005);
  }
} // namespace



TEST(PorePressure, SlabOnSeabed)
{
  expect_slab_to_slide("seabed", {"Grid/Lower corner=0,0"});
}



TEST(PorePressure, SlabOnObstacle)
{
  expect_slab_to_slide("obstacle",
                       {"Boundaries/Bottom=free",
                        "Obstacles/Names=plane",
                        "Obstacles/plane/Shape=half-plane",
                        "Obstacles/plane/Point=0,0",
                        "Obstacles/plane/Normal=0,1",
                        text("Obstacles/plane/Friction coefficient=", mu)});
}



namespace
{
  const std::string sand = "verification/infinite-slope-friction.prm";

  /// Slope angle and friction angle in degrees.
  Overrides
  sand_slope(const double slope, const double friction)
  {
    return {text("Gravity/Slope angle=", slope),
            text("Materials/sand/Friction angle=", friction),
            "Strength reduction/Tolerance=1e-4"};
  }
} // namespace



// With psi = 0 sand shears along lines of no extension, where
// sin(phi_F) = t/(s_n - u), tan(phi_F) = tan(phi)/F.
TEST(PorePressure, FactorOfSafetyOfSand)
{
  Verification gates("Infinite slope of sand with excess pore pressure",
                     "prm/" + sand,
                     "lines of no extension, psi = 0, K0 = 0.5");
  struct Row
  {
    double slope, friction, r_u, exact;
  };
  for (const Row &row : {Row{10., 30., 0.3, 2.2181136403},
                         Row{5., 28., 0.6, 2.3721258716},
                         Row{3., 25., 0.8, 1.7173542616}})
    gates.near(text("factor of safety, r_u = ", row.r_u),
               StaticCase<2>(sand,
                             text("pore-sand-", row.slope),
                             sand_slope(row.slope, row.friction) +
                               Overrides{text("Excess pore pressure/Initial=",
                                              row.r_u,
                                              "*overburden")})
                 .factor_of_safety(),
               row.exact,
               0.002);
}



// Davis' factor does not depend on the path: a pressure that rises in soil at
// rest gives the same factor as a pressure at the start. The slope fails at the
// second pressure. Afterwards the soil has the pressure at the start.
TEST(PorePressure, FactorOfSafetyAtTheEndOfTheRise)
{
  Verification gates("Infinite slope of sand, pressure at the end of the rise",
                     "prm/" + sand,
                     "Davis with psi = 0: sin(phi_F) = t/(s_n - u)");
  for (const double r_u : {0.3, 0.8})
    {
      const StaticCase<2> at_end(
        sand,
        text("pore-sand-final-", r_u),
        sand_slope(10., 30.) +
          Overrides{"Strength reduction/Non-associated flow=Davis",
                    "Excess pore pressure/Initial=0.1*overburden",
                    text("Excess pore pressure/Final=", r_u, "*overburden"),
                    "Excess pore pressure/Stage value=final"});
      gates.near(text("factor of safety, r_u = ", r_u),
                 at_end.factor_of_safety(),
                 std::tan(30. * per_degree) /
                   std::tan(std::asin(std::tan(10. * per_degree) / (1. - r_u))),
                 0.002);
      const auto &points = at_end.points();
      for (const double ratio : pore_pressure_ratio(points))
        EXPECT_NEAR(ratio, 0.1, 1e-12);
    }
}



// Undrained, the mean effective stress stays in the end: m s_n sin(phi_F) = t
// with m = (1 + 2 K0)/3.
TEST(PorePressure, FactorOfSafetyOfUndrainedSand)
{
  Verification gates("Infinite slope of undrained sand",
                     "prm/" + sand,
                     "constant mean effective stress, psi = 0, K0 = 0.5");
  const auto   factor = [](const double slope, const double friction) {
    return StaticCase<2>(
             sand,
             text("undrained-sand-", slope),
             sand_slope(slope, friction) +
               Overrides{
                 "Materials/sand/Poisson's ratio=0.3",
                 "Materials/sand/Pore water/Drainage=undrained",
                 "Materials/sand/Pore water/Undrained Poisson's ratio=0.4999"})
      .factor_of_safety();
  };
  gates.near("factor of safety, slope of 5 degrees",
             factor(5., 28.),
             4.0166039758,
             0.002);
  gates.falls_short(
    "factor of safety - 2.10514, relative, slope of 10 degrees",
    std::abs(factor(10., 30.) / 2.1051414126 - 1.),
    0.002,
    {0.003,
     "the factor of safety is the largest of the path, and the path passes "
     "more while the stress out of the plane has not yet turned"});
}



// In the dynamics the slope moves by itself when r_u reaches
// 1 - tan(10 degrees)/sin(30 degrees). Before, it creeps by up to 4 mm/s as the
// stress turns; from then on 5 mm/s take half a second, in which r_u grows by
// 0.6 %.
TEST(PorePressure, SandBeginsToMove)
{
  const Table table =
    run<2>(sand,
           "pore-sand-moves",
           sand_slope(10., 30.) +
             Overrides{"Stages=dynamics",
                       "End time=120",
                       "Grid/Cell size=0.5",
                       "Grid/Upper corner=0.5,6",
                       "Bodies/layer/Upper corner=0.5,5",
                       "Materials/sand/Young's modulus=1e8",
                       "Materials/sand/Poisson's ratio=0.3",
                       "Excess pore pressure/Final=0.8*overburden",
                       "Excess pore pressure/Duration=160",
                       "Output/Statistics interval=0.1"});
  const auto  &speed = table["centre velocity x [m/s]"];
  unsigned int begin = 0;
  while (begin + 1 < speed.size() && speed[begin] < 5e-3)
    ++begin;
  Verification gates("Infinite slope of sand with rising pore pressure",
                     "prm/" + sand,
                     "1 - tan(10 degrees)/sin(30 degrees)");
  gates.near("r_u when it moves at 5 mm/s",
             0.4 * (1. - std::cos(M_PI * table["time [s]"][begin] / 160.)),
             0.6473460386,
             0.01);
  EXPECT_GT(speed.back(), 0.1);
}



// The example: a slope of sand that rising pressure sets going and that comes
// to rest. It begins to move at 1 - tan(slope)/tan(phi) = 0.615 of an infinite
// slope without cohesion, or with up to 0.65 for the cohesion of 1 kPa; sand
// that loses all effective stress as it thins must not be blown up.
TEST(SandSlope, SlidesByItselfAndRests)
{
  const Table table =
    run<2>("sand-slope.prm",
           "sand-slope",
           {"Stages=equilibrium, dynamics", "Output/Statistics interval=0.1"});
  const auto  &time  = table["time [s]"];
  const auto  &speed = table["maximum speed [m/s]"];
  unsigned int begin = 0;
  while (begin + 1 < speed.size() && speed[begin] < 0.05)
    ++begin;
  const double r_u    = 0.45 * (1. - std::cos(M_PI * time[begin] / 20.));
  const auto  &height = table["height [m]"];
  Verification gates("Slope of sand with rising pore pressure",
                     "prm/sand-slope.prm",
                     "infinite slope by limit equilibrium, with the cohesion");
  gates.at_least("r_u when it moves at 5 cm/s", r_u, 0.615, "0.615");
  gates.at_most("r_u when it moves at 5 cm/s", r_u, 0.65, "0.65");
  gates.at_most("highest soil above the crest at the start [m]",
                *std::max_element(height.begin(), height.end()) - height[0],
                0.5);
  gates.at_most("end of the run, at rest [s]", time.back(), 59., "rest");
  EXPECT_GT(table["front x [m]"].back() - table["front x [m]"][0], 5.);
}
