// SPDX-License-Identifier: LGPL-2.1-or-later
// The ground moves: a block that flies above it, and one that slides on it.

#include "case.h"
#include "driven.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// Write a table to the results; returns the entry that names it.
  std::string
  table(const std::string &name, const std::string &content)
  {
    const auto folder = std::filesystem::path(TALUS_RESULTS_DIR);
    std::filesystem::create_directories(folder);
    const auto path = folder / (name + ".csv");
    std::ofstream(path) << content;
    return "Ground motion/File=" + path.string();
  }



  const std::string block_file = "verification/block-on-incline.prm";
} // namespace



// Seen from the ground, what flies has the acceleration g(t) - a(t), which is
// uniform; velocities live at half steps, so that they are sums of dt g(t^n).
// So soft that the nodes which carry next to nothing, and are skipped, hardly
// matter.
TEST(GroundMotion, SeenFromTheGround)
{
  Case<2>    block(block_file,
                {table("motion",
                       "time [s],horizontal [m/s^2],vertical [m/s^2],gravity "
                          "factor [-]\n0,0,0,1\n0.1,4,2,1\n0.3,-4,0,0.5\n"
                          "0.4,0,0,0.5\n"),
                    "Ground motion/Start time=0.05",
                    "Ground motion/Factor=1.5",
                    "Bodies/block/Lower corner=0,0.75",
                    "Bodies/block/Upper corner=2,1.75",
                    "Bodies/block/Initial velocity=0; 0.5",
                    "Materials/stiff/Submerged density=1000",
                    "Gravity/Magnitude=2",
                    "Materials/stiff/Young's modulus=1",
                    "Time step/Maximum=5e-4",
                    "Output/Write points=false"});
  const auto linear = [](const double                              s,
                         const std::vector<std::array<double, 2>> &rows) {
    for (unsigned int i = 1; i < rows.size(); ++i)
      if (s >= rows[i - 1][0] && s <= rows[i][0])
        return rows[i - 1][1] + (rows[i][1] - rows[i - 1][1]) *
                                  (s - rows[i - 1][0]) /
                                  (rows[i][0] - rows[i - 1][0]);
    return s < rows[0][0] ? rows[0][1] : rows.back()[1];
  };
  double       v[2] = {0., 0.5}, error = 0, energy_error = 0;
  const double mass = 2000. * 2.;
  const double c = std::cos(M_PI / 6.), s = std::sin(M_PI / 6.);
  while (block->state().time < 0.5 - 1e-12)
    {
      const double t = block->state().time - 0.05;
      const double h =
        1.5 * linear(t, {{{0., 0.}}, {{0.1, 4.}}, {{0.3, -4.}}, {{0.4, 0.}}});
      const double u =
        1.5 * linear(t, {{{0., 0.}}, {{0.1, 2.}}, {{0.3, 0.}}, {{0.4, 0.}}});
      const double g =
        linear(t, {{{0., 1.}}, {{0.1, 1.}}, {{0.3, 0.5}}, {{0.4, 0.5}}});
      block->advance();
      const double dt = block->state().time_step;
      v[0] += dt * (g * s - (h * c - u * s));
      v[1] += dt * (-g * c - (h * s + u * c));
      for_points(block, [&](const unsigned int p) {
        for (unsigned int d = 0; d < 2; ++d)
          error =
            std::max(error,
                     std::abs(value(block, block.points().velocity + d, p) -
                              v[d]));
      });
      const double kinetic = 0.5 * mass * (v[0] * v[0] + v[1] * v[1] - 0.25);
      energy_error =
        std::max(energy_error,
                 std::abs(block->state().accounts.energy("gravity work") -
                          kinetic) /
                   mass);
    }
  Verification gates("Block that flies above moving ground",
                     "prm/" + block_file + " with a table",
                     "v = integral of g(t) - a(t)");
  gates.at_most("velocity, largest error [m/s]", error, 1e-9);
  gates.at_most("work of the loads - kinetic energy [J/kg]",
                energy_error,
                1e-12);
  EXPECT_GT(std::abs(v[0]), 0.05);
}



// On a slope of 30 degrees in 3-D: constant acceleration, seen along the mesh.
TEST(GroundMotion, AxesInSpace)
{
  Case<3> soil("layers-at-rest-3d.prm",
               {table("constant",
                      "time [s],across [m/s^2],horizontal [m/s^2],vertical "
                      "[m/s^2]\n0,3,1,2\n9,3,1,2\n"),
                "End time=0.1",
                "Gravity/Magnitude=0",
                "Gravity/Slope angle=30",
                "Bodies/lower/K0=",
                "Bodies/upper/K0=",
                "Boundaries/Left=free",
                "Boundaries/Right=free",
                "Boundaries/Bottom=free",
                "Boundaries/Back=free",
                "Boundaries/Front=free",
                "Grid/Lower corner=-0.5, -0.5, -0.5",
                "Grid/Upper corner=2, 4, 1.5"});
  while (soil->state().time < 0.1 - 1e-12)
    soil->advance();
  const double c = std::cos(M_PI / 6.), s = std::sin(M_PI / 6.);
  const double exact[3] = {-0.1 * (c - 2. * s), -0.1 * (s + 2. * c), -0.3};
  for (unsigned int p = 0; p < soil.points().size(); ++p)
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(soil.points().data(soil.points().velocity, d)[p],
                  exact[d],
                  1e-4);
}



// A rigid block on ground that is accelerated by a > mu g for a time T slides
// back by d = a T^2 (a - mu g)/(2 mu g) @cite newmark1965. It starts in
// equilibrium; the stiffer it is, the closer (1 % off with E = 1e8 Pa, 0.4 %
// with 4e8 Pa).
TEST(GroundMotion, NewmarkSlidingBlock)
{
  constexpr double a = 6., T = 0.3, mu = 0.3, g = 9.81;
  Case<2>          block(
    block_file,
    {table("pulse",
           text("time [s],horizontal [m/s^2]\n0,0\n0.2,0\n0.2000001,",
                -a,
                "\n",
                0.2000001 + T,
                ',',
                -a,
                "\n")),
              "End time=1.5",
              "Materials/stiff/Young's modulus=1.6e9",
              "Gravity/Slope angle=0",
              "Bodies/block/Initial stress=0; -2000*9.81*(1-y); 0; 0",
              "Output/Write points=false"});
  const auto place = [&]() {
    double sum = 0;
    for_points(block, [&](const unsigned int p) {
      sum += value(block, block.points().position, p);
    });
    return sum / block.points().size();
  };
  const double start = place();
  advance_to(block, 0.199);
  const double before = place() - start;
  advance_to(block, 1.25);
  const double then = place();
  advance_to(block, 1.5);
  const double exact = a * T * T * (a - mu * g) / (2. * mu * g);
  Verification gates("Newmark's sliding block",
                     "prm/" + block_file + ", level, with a pulse of 6 m/s^2",
                     "d = a T^2 (a - mu g)/(2 mu g)");
  gates.near("displacement [m]", then - start, exact, 0.005);
  gates.at_most("displacement before the pulse [m]", std::abs(before), 1e-6);
  gates.at_most("creep after it [m/s]", std::abs(place() - then) / 0.25, 1e-3);
}
