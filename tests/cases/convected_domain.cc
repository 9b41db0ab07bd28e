// SPDX-License-Identifier: LGPL-2.1-or-later
// Large rotation and large stretch with domains that go with the material,
// prm/verification/cantilever.prm and hanging-cube*.prm, against finite
// elements.

#include "case.h"
#include "elastic_block.h"
#include "verification.h"

#include <talus/base/errors.h>
#include <talus/observers/fracture.h>
#include <talus/observers/statistics.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;
using dealii::Point;
using dealii::Tensor;

namespace
{
  /// How far down something goes, when, and how far it comes back after that.
  struct Swing
  {
    double depth, time, back; // m, s, m
  };



  /// Of heights at @p times, the first of them being that at rest.
  Swing
  swing_of(const std::vector<double> &times, const std::vector<double> &heights)
  {
    const auto lowest  = std::min_element(heights.begin(), heights.end());
    const auto highest = std::max_element(lowest, heights.end());
    return {heights[0] - *lowest,
            times[lowest - heights.begin()],
            *highest - heights[0]};
  }



  template <int dim>
  Swing
  swing_of_elements(const typename ElasticBlock<dim>::Data &data,
                    const Point<dim>                       &place,
                    const double                            dt,
                    const double                            end)
  {
    std::vector<double> times, heights;
    for (const auto &u : ElasticBlock<dim>(data).displacements(place, dt, end))
      {
        times.push_back(times.size() * dt);
        heights.push_back(u[1]);
      }
    return swing_of(times, heights);
  }



  /// Height of the place @p X of the undeformed body: mean of what the points
  /// around say of it by their deformation gradients.
  template <int dim>
  double
  height_of(const Points<dim> &points, const Point<dim> &X, const double reach)
  {
    double sum = 0, n = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const Tensor<1, dim> to_X =
          X - load_place(points, points.initial_position, p);
        bool is_near = true;
        for (unsigned int d = 0; d < dim; ++d)
          is_near = is_near && std::abs(to_X[d]) < reach;
        if (!is_near)
          continue;
        const auto F =
          load_matrix<dim, double>(points,
                                   points.find("deformation gradient"),
                                   p);
        sum += points.data(points.position, 1)[p];
        for (unsigned int d = 0; d < dim; ++d)
          sum += F[1][d] * to_X[d];
        ++n;
      }
    return sum / n;
  }



  struct Result
  {
    Swing        swing;
    double       remainder = 0; // largest, over the largest work of gravity
    unsigned int n_bodies  = 0; // at most
  };



  /// Run to @p end, looking at the height of @p place after each step, and at
  /// the rest now and then.
  template <int dim>
  Result
  run_block(const std::string &file,
            const Overrides   &overrides,
            const Point<dim>  &place,
            const double       reach,
            const double       end)
  {
    Case<dim>         block(file, overrides);
    EnergyBudget<dim> budget;
    budget.begin(block->state());
    std::vector<double> times, heights;
    double              work = 0, remainder = 0;
    Result              result;
    while (true)
      {
        const auto &state = block->state();
        times.push_back(state.time);
        heights.push_back(height_of(block.points(), place, reach));
        if (times.size() % 10 == 1)
          {
            work =
              std::max(work, std::abs(state.accounts.energy("gravity work")));
            remainder       = std::max(remainder,
                                 std::abs(budget.evaluate(state).back().value));
            result.n_bodies = std::max<unsigned int>(
              result.n_bodies,
              count_fractures(state.points,
                              state.grid,
                              Ground<dim>(state.grid.domain()))
                .connected_bodies);
          }
        if (state.time >= end)
          break;
        block->advance();
      }
    result.swing     = swing_of(times, heights);
    result.remainder = remainder / work;
    return result;
  }



  const std::string elements = "finite elements, total Lagrangian";
} // namespace



// ------------------------------------------------------------------ cantilever

namespace
{
  const std::string cantilever = "verification/cantilever.prm";

  Swing
  cantilever_of_elements()
  {
    Tensor<1, 2> gravity;
    gravity[1] = -10.;
    return swing_of_elements<2>(
      {{{4., 1.}}, {{32, 8}}, 1050., 1e6, 0.3, gravity, 0},
      Point<2>(4., 0.5),
      2.5e-4,
      2.8);
  }



  void
  hold_cantilever(const std::string &name,
                  const Overrides   &overrides,
                  const double       cell_size)
  {
    const Swing  reference = cantilever_of_elements();
    const Result found     = run_block(
      cantilever, overrides, Point<2>(4., 6.5), 0.26 * cell_size, 2.8);
    Verification gates("Cantilever under sudden gravity, " + name,
                       "prm/" + cantilever,
                       elements);
    gates.near("largest deflection [m]",
               found.swing.depth,
               reference.depth,
               0.02);
    gates.near("time of it [s]", found.swing.time, reference.time, 0.04);
    gates.at_least("comes back to [m]", found.swing.back, -0.2, "0");
    gates.at_most("energy remainder/largest work of gravity",
                  found.remainder,
                  0.05);
    gates.at_most("bodies, at most", found.n_bodies, 1, "1");
  }
} // namespace



/// The elements against the values that were found for them elsewhere.
TEST(Cantilever, FiniteElements)
{
  const Swing swing = cantilever_of_elements();
  EXPECT_NEAR(swing.depth, 3.779, 0.001);
  EXPECT_NEAR(swing.time, 1.082, 0.002);
  EXPECT_GT(swing.back, -0.05);
}



TEST(Cantilever, ConvectedDomains)
{
  hold_cantilever("h = 0.25 m", {}, 0.25);
}



TEST(Cantilever, ConvectedDomainsSplit)
{
  hold_cantilever("points split", {"Splitting/Enabled=true"}, 0.25);
}



/// The control: boxes parallel to the axes tear, or the gates would not see
/// the domains.
TEST(Cantilever, BoxesTear)
{
  const Result found = run_block(cantilever,
                                 {"Transfer/Box rule=axis-parallel"},
                                 Point<2>(4., 6.5),
                                 0.065,
                                 2.8);
  EXPECT_LT(found.swing.back, -1.);
  EXPECT_GT(found.remainder, 0.2);
}



// --------------------------------------------------------------- hanging block

namespace
{
  const std::string hanging = "verification/hanging-cube.prm";

  void
  hold_hanging_cube(const double cell_size)
  {
    Tensor<1, 2> gravity;
    gravity[1] = -1000.;
    const Swing reference =
      swing_of_elements({{{1., 1.}}, {{16, 16}}, 1050., 1e6, 0.3, gravity, 3},
                        Point<2>(0.5, 0.),
                        5e-5,
                        0.2);
    EXPECT_NEAR(reference.depth, 1.583, 0.001);
    const Result found = run_block(hanging,
                                   {text("Grid/Cell size=", cell_size)},
                                   Point<2>(0.5, 3.),
                                   0.26 * cell_size,
                                   0.25);
    Verification gates(
      text("Hanging cube, plane strain, h = ", cell_size, " m"),
      "prm/" + hanging,
      elements);
    gates.near("largest displacement of the lower end [m]",
               found.swing.depth,
               reference.depth,
               0.02);
    gates.at_most("|comes back to| [m]", std::abs(found.swing.back), 0.1);
    gates.at_most("bodies, at most", found.n_bodies, 1, "1");
  }
} // namespace



TEST(HangingCube, ConvectedDomains)
{
  hold_hanging_cube(0.125);
}



TEST(HangingCube, ConvectedDomainsFine)
{
  hold_hanging_cube(0.0625);
}



/// The cube itself.
TEST(HangingCube, ConvectedDomainsInThreeDimensions)
{
  Tensor<1, 3> gravity;
  gravity[1]            = -1000.;
  const Swing reference = swing_of_elements<3>(
    {{{1., 1., 1.}}, {{12, 12, 12}}, 1050., 1e6, 0.3, gravity, 3},
    Point<3>(0.5, 0., 0.5),
    1e-4,
    0.11);
  const std::string file = "verification/hanging-cube-3d.prm";
  const Result      found =
    run_block<3>(file, {}, Point<3>(0.5, 3., 0.5), 0.26 * 0.125, 0.11);
  Verification gates("Hanging cube, h = 0.125 m", "prm/" + file, elements);
  gates.near("largest displacement of the lower end [m]",
             found.swing.depth,
             reference.depth,
             0.02);
  gates.near("time of it [s]", found.swing.time, reference.time, 0.05);
}
