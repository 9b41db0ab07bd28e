// SPDX-License-Identifier: LGPL-2.1-or-later
// Obstacles with a mass: springs without soil, body-on-springs.prm, and a pipe
// that a force drags through clay, prm/verification/pipe.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace talus;
using namespace talus::cases;

namespace moving_obstacle_test
{
  constexpr double mass = 50, omega = 2 * M_PI, force = 100;
  constexpr double stiffness = mass * omega * omega;

  /// A run and its two tables.
  struct Results
  {
    Table statistics, obstacles;
  };



  template <int dim = 2>
  Results
  results_of(const std::string &file,
             const std::string &folder,
             const Overrides   &overrides)
  {
    const Table statistics = run<dim>(file, folder, overrides);
    return {statistics,
            Table(std::filesystem::path(TALUS_RESULTS_DIR) / folder /
                  "obstacles.csv")};
  }



  Results
  on_springs(const Overrides &overrides = {})
  {
    return results_of("body-on-springs.prm", "body-on-springs", overrides);
  }



  Overrides
  ball(const Overrides &entries)
  {
    Overrides result;
    for (const std::string &entry : entries)
      result.push_back("Obstacles/ball/" + entry);
    return result;
  }



  /// Times at which a column passes zero upwards, linear between the rows.
  std::vector<double>
  upward_crossings(const Table &table, const std::string &column)
  {
    const auto         &t = table["time [s]"], &v = table[column];
    std::vector<double> result;
    for (std::size_t i = 1; i < v.size(); ++i)
      if (v[i - 1] < 0 && v[i] >= 0)
        result.push_back(t[i - 1] -
                         v[i - 1] * (t[i] - t[i - 1]) / (v[i] - v[i - 1]));
    return result;
  }



  /// Maximum difference between a column and a function of time.
  double
  deviation(const Table                         &table,
            const std::string                   &column,
            const std::function<double(double)> &exact)
  {
    const auto &t = table["time [s]"], &x = table[column];
    double      result = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      result = std::max(result, std::abs(x[i] - exact(t[i])));
    return result;
  }



  double
  largest(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result = std::max(result, std::abs(value));
    return result;
  }



  double
  remainder_over_work(const Results &results)
  {
    return largest(results.statistics["energy remainder [J]"]) /
           largest(results.statistics["obstacle force work [J]"]);
  }



  TEST(BodyOnSprings, Oscillates)
  {
    Verification  gates("Body on a spring, without soil",
                       "tests/cases/body-on-springs.prm",
                       "x = F/k (1 - cos(omega t))");
    const Results results = on_springs();
    const auto    starts =
      upward_crossings(results.obstacles, "ball displacement x [m]");
    const auto passes =
      upward_crossings(results.obstacles, "ball velocity x [m/s]");
    ASSERT_GE(passes.size(), 3u);
    gates.near("period, s",
               (passes.back() - passes.front()) / (passes.size() - 1),
               1.,
               1e-4);
    gates.at_most("displacement, error over 2 F/k",
                  deviation(results.obstacles,
                            "ball displacement x [m]",
                            [](const double t) {
                              return force / stiffness *
                                     (1 - std::cos(omega * t));
                            }) /
                    (2 * force / stiffness),
                  0.01);
    gates.at_most("energy remainder over work of the force",
                  remainder_over_work(results),
                  1e-12);
    EXPECT_EQ(largest(results.obstacles["ball displacement y [m]"]), 0.);
  }



  // The exact displacement begins with the velocity 0 at t = 0, which talus
  // knows half a step earlier: the time step is short.
  TEST(BodyOnSprings, IsDamped)
  {
    constexpr double zeta = 0.1;
    const Results    results =
      on_springs({"Time step/Maximum=2e-4",
                  "Obstacles/ball/Spring damping=" +
                    std::to_string(2 * zeta * mass * omega) + ",0"});
    const double slower = omega * std::sqrt(1 - zeta * zeta);
    Verification gates("Body on a spring with a dashpot, without soil",
                       "tests/cases/body-on-springs.prm",
                       "damped oscillation");
    gates.at_most("displacement, error over F/k",
                  deviation(results.obstacles,
                            "ball displacement x [m]",
                            [&](const double t) {
                              return force / stiffness *
                                     (1 - std::exp(-zeta * omega * t) *
                                            (std::cos(slower * t) +
                                             zeta * omega / slower *
                                               std::sin(slower * t)));
                            }) /
                    (force / stiffness),
                  2e-3);
    gates.at_most("energy remainder over work of the force",
                  remainder_over_work(results),
                  1e-12);
    EXPECT_GT(results.statistics["spring work [J]"].back(), 1.);
  }



  // The force ends at t = 0.6 s, when the spring yields.
  TEST(BodyOnSprings, Yields)
  {
    constexpr double yield = force / 1.5, end = 0.6;
    const Results    results = on_springs(
      {"Time step/Maximum=2e-4",
          "End time=2",
          "Obstacles/ball/Spring yield force=" + std::to_string(yield) + ",0",
          "Obstacles/ball/Force=if(t<0.6, 100, 0); 0"});
    const double t_y = std::acos(1 - yield / force) / omega;
    const double v_y = force / stiffness * omega * std::sin(omega * t_y);
    const double a   = (force - yield) / mass;
    const double v_1 = v_y + a * (end - t_y);
    const double x_1 =
      yield / stiffness + v_y * (end - t_y) + 0.5 * a * std::pow(end - t_y, 2);
    // The constant force of the spring stops the body.
    const double x_max = x_1 + 0.5 * mass * v_1 * v_1 / yield;
    const double slip  = x_max - yield / stiffness;
    Verification gates("Body on a spring that yields, without soil",
                       "tests/cases/body-on-springs.prm",
                       "elastic, perfectly plastic spring");
    const auto  &x = results.obstacles["ball displacement x [m]"];
    gates.near("largest displacement, m", largest(x), x_max, 1e-3);
    gates.near("plastic elongation, m",
               results.obstacles["ball spring slip x [m]"].back(),
               slip,
               1e-3);
    gates.near("work of yielding, J",
               results.statistics["spring work [J]"].back(),
               yield * slip,
               1e-3);
    gates.at_most("energy remainder over work of the force",
                  remainder_over_work(results),
                  1e-12);
  }



  TEST(BodyOnSprings, Rotates)
  {
    // The force acts at the centre, the moment about it.
    const Results results =
      on_springs(ball({"Free axes=rotation",
                       "Moment of inertia=50",
                       "Force=100; 50; 100",
                       "Spring stiffness=0,0," + std::to_string(stiffness)}));
    const auto passes =
      upward_crossings(results.obstacles, "ball angular velocity [rad/s]");
    ASSERT_GE(passes.size(), 3u);
    Verification gates("Body on a torsion spring, without soil",
                       "tests/cases/body-on-springs.prm",
                       "period of 1 s");
    gates.near("period, s",
               (passes.back() - passes.front()) / (passes.size() - 1),
               1.,
               1e-4);
    gates.at_most("energy remainder over work of the force",
                  remainder_over_work(results),
                  1e-12);
    EXPECT_EQ(largest(results.obstacles["ball displacement x [m]"]), 0.);
    EXPECT_EQ(largest(results.obstacles["ball displacement y [m]"]), 0.);
  }



  constexpr double dashpot = 1e4, speed = 0.173335949745;
  constexpr double displaced = 1000 * M_PI * 0.25; // mass, kg/m

  /// Overrides of the pipe: instead of a velocity a force that holds the
  /// terminal velocity @p speed against a dashpot and N s_u D.
  Overrides
  dragged(const double       alpha,
          const double       bearing_factor,
          const double       mass,
          const std::string &direction = "1")
  {
    return {"Obstacles/pipe/Velocity=",
            "Obstacles/pipe/Mass=" + std::to_string(mass),
            "Obstacles/pipe/Free axes=x",
            "Obstacles/pipe/Spring damping=" + std::to_string(dashpot) + ",0",
            "Obstacles/pipe/Force=" + direction + "*" +
              std::to_string(1e3 * bearing_factor + dashpot * speed) +
              "*if(t<t0, 0.5*(1-cos(pi*t/t0)), 1); 0",
            "Obstacles/pipe/Maximum shear stress=" +
              std::to_string(1e3 * alpha)};
  }



  /// Mean force against the motion over s_u D, at displacements of 0.15 D to
  /// 0.2 D.
  double
  factor_of_terminal_force(const Results &results)
  {
    const auto &x   = results.obstacles["pipe displacement x [m]"];
    const auto &f   = results.obstacles["pipe force x [N]"];
    double      sum = 0;
    int         n   = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (std::abs(x[i]) > 0.15 && std::abs(x[i]) < 0.2)
        {
          sum += f[i];
          ++n;
        }
    return std::abs(sum / n) / 1e3;
  }



  Results
  drag(const std::string &name, const Overrides &overrides)
  {
    return results_of("verification/pipe.prm",
                      "dragged-pipe-" + name,
                      overrides + Overrides{"End time=2.2"});
  }



  TEST(DraggedPipe, TerminalForce)
  {
    Verification  gates("Pipe dragged through clay by a force, cells of D/8",
                       "prm/verification/pipe.prm with a mass",
                       "Randolph & Houlsby 1984");
    const Results smooth = drag("smooth", dragged(0, 9.142, displaced));
    const Results rough  = drag("rough", dragged(1, 11.94, displaced));
    const double  n_s    = factor_of_terminal_force(smooth);
    const double  n_r    = factor_of_terminal_force(rough);
    gates.at_least("N of a smooth pipe", n_s, 9.1, "9.142");
    gates.at_most("N of a smooth pipe", n_s, 9.6, "9.142");
    gates.at_least("N of a rough pipe", n_r, 11.6, "11.940");
    gates.at_most("N of a rough pipe", n_r, 12.2, "11.940");
    for (const Results *results : {&smooth, &rough})
      gates.at_most("energy remainder over work of the force",
                    remainder_over_work(*results),
                    0.01);
  }



  // A body lighter than the soil at its facets: with the impulses of the
  // previous step it would be thrown to and fro.
  TEST(DraggedPipe, LightAndHeavy)
  {
    const Overrides coarse = {"Grid/Cell size=0.25"};
    const Results   middle = drag("middle", dragged(1, 12, displaced) + coarse);
    const Results   light =
      drag("light", dragged(1, 12, 0.01 * displaced) + coarse);
    const double bearing = factor_of_terminal_force(middle);
    Verification gates(
      "Light pipe dragged through clay, cells of D/4",
      "prm/verification/pipe.prm with 1/100 of the mass of the "
      "displaced soil",
      "the pipe as heavy as the displaced soil");
    gates.near("N of the pipe", factor_of_terminal_force(light), bearing, 0.02);
    const std::string x = "pipe displacement x [m]";
    const std::string v = "pipe velocity x [m/s]";
    gates.near("displacement at the end, m",
               light.obstacles[x].back(),
               middle.obstacles[x].back(),
               0.02);
    gates.near("largest velocity, m/s",
               largest(light.obstacles[v]),
               largest(middle.obstacles[v]),
               0.1);
    // The clay alone loses 3.0 % where the velocity of the pipe is prescribed.
    gates.at_most("energy remainder over work of the force",
                  remainder_over_work(light),
                  0.025);

    const double  mass  = 100 * displaced;
    const Results heavy = drag("heavy", dragged(1, 12, mass) + coarse);
    const auto   &last  = heavy.obstacles;
    const double  t     = last["time [s]"].back();
    EXPECT_GT(t, 2.19);
    // The momentum is the impulse of soil, dashpot and force.
    const double of_force =
      (12e3 + dashpot * speed) * (0.5 * 1.153828737 + (t - 1.153828737));
    const double of_dashpot = dashpot * last["pipe displacement x [m]"].back();
    EXPECT_NEAR(mass * last["pipe velocity x [m/s]"].back(),
                last["pipe impulse x [N s]"].back() + of_force - of_dashpot,
                1e-3 * of_force);
  }



  // About 1200 steps: with a prescribed velocity, and with a force and a
  // dashpot, where the force of the soil also changes the velocity.
  TEST(DraggedPipe, MirroredDirection)
  {
    Verification gates("Pipe dragged to the right and to the left",
                       "prm/verification/pipe.prm, Grid/Cell size=0.25",
                       "symmetry");
    const auto   run = [](const std::string &name, const Overrides &motion) {
      return drag("mirrored",
                  motion + Overrides{"Grid/Cell size=0.25", "End time=1.7"})
        .obstacles["pipe " + name];
    };
    const auto at_most = [&](const std::string &what,
                             const std::string &column,
                             const Overrides   &right,
                             const Overrides   &left) {
      const auto a = run(column, right), b = run(column, left);
      ASSERT_EQ(a.size(), b.size());
      double error = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        error = std::max(error, std::abs(a[i] + b[i]));
      gates.at_most(what + ": difference of the " + column +
                      ", over the largest",
                    error / largest(a),
                    1e-9);
    };
    const std::string velocity = "v*if(t<t0, 0.5*(1-cos(pi*t/t0)), 1); 0";
    at_most("prescribed velocity",
            "force x [N]",
            {"Obstacles/pipe/Velocity=" + velocity},
            {"Obstacles/pipe/Velocity=-" + velocity});
    at_most("force and dashpot",
            "displacement x [m]",
            dragged(1, 12, displaced, "1"),
            dragged(1, 12, displaced, "-1"));
  }



  // A disc that a moment turns in clay: a rough surface slips along the circle
  // of radius R with the moment 2 pi R^2 s_u.
  TEST(DraggedPipe, TurnsInClay)
  {
    const double  limit = 2 * M_PI * 0.25 * 500; // surface of 500 Pa
    const Results results =
      drag("turned",
           {"Obstacles/pipe/Velocity=",
            "Obstacles/pipe/Mass=785",
            "Obstacles/pipe/Free axes=rotation",
            "Obstacles/pipe/Moment of inertia=98",
            "Obstacles/pipe/Maximum shear stress=500",
            "Obstacles/pipe/Spring damping=0,0,1000",
            "Obstacles/pipe/Force=0; 0; " + std::to_string(limit + 500) +
              "*if(t<t0, 0.5*(1-cos(pi*t/t0)), 1)"});
    const auto  &moment = results.obstacles["pipe moment z [N m]"];
    Verification gates("Rough disc turned in clay by a moment, cells of D/8",
                       "prm/verification/pipe.prm with a moment of inertia",
                       "2 pi R^2 times the shear stress of the surface");
    gates.near("moment of the clay, N m", -moment.back(), limit, 0.02);
    gates.near("angular velocity, rad/s",
               results.obstacles["pipe angular velocity [rad/s]"].back(),
               0.5,
               0.05);
    gates.at_most("energy remainder over work of the force",
                  remainder_over_work(results),
                  0.02);
  }
} // namespace moving_obstacle_test
