// SPDX-License-Identifier: LGPL-2.1-or-later
// The bar of the paper: axial vibration in the first mode, prm/bar.prm.
// u = (v0/w) sin(w t) sin(b x), b = pi/(2 L), w = b c, c = sqrt(E/rho), so that
// the centre of mass moves with (2 v0/pi) cos(w t).

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double length = 25., speed_of_sound = 3.16227766016838; // m, m/s
  constexpr double omega  = M_PI / (2. * length) * speed_of_sound;  // 1/s
  constexpr double period = 2. * M_PI / omega;                      // s

  const Overrides unsplit = {"Splitting/Enabled=false"};

  /// (v_cm - exact)/v0 at each row. A velocity lives half a step before the
  /// time of its row: @p at is its place within the step.
  std::vector<double>
  deviation(const Table &table, const double v0, const double at = 0.5)
  {
    std::vector<double> result;
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      {
        const double t =
          table["time [s]"][i] - (1. - at) * table["time step [s]"][i];
        const double exact = 2. * v0 / M_PI * std::cos(omega * t);
        result.push_back((table["centre velocity x [m/s]"][i] - exact) / v0);
      }
    return result;
  }



  double
  largest(const std::vector<double> &values)
  {
    double result = 0;
    for (const double value : values)
      result = (std::abs(value) <= result ? result : std::abs(value));
    return result;
  }



  /// Relative to the energy at the start, rho v0^2 L/4 times the height.
  double
  energy_drift(const Table &table)
  {
    const double start = 1000. * 0.1 * 0.1 * length / 4. * 0.5; // J/m
    double       drift = 0;
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      drift = std::max(drift,
                       std::abs(table["kinetic energy [J]"][i] +
                                table["elastic energy [J]"][i] - start) /
                         start);
    return drift;
  }



  const std::string source = "linear closed form; 1.1 % is the law's own";

  struct TenPeriods
  {
    Table  table;
    double error, drift;
  };

  TenPeriods
  run_ten_periods(const std::string &name, const Overrides &overrides)
  {
    const Table table = run<2>("bar.prm", "bar-" + name, overrides);
    EXPECT_GE(table["time [s]"].back(), 10. * period - 1e-3);
    EXPECT_LE(table["split conservation error [-]"].back(), 1e-12) << name;
    return {table, largest(deviation(table, 0.1)), energy_drift(table)};
  }



  /// What is expected of ten periods whatever the box rule.
  void
  hold(Verification      &gates,
       const std::string &name,
       const TenPeriods  &result,
       const double       n_splits)
  {
    gates.at_most("error of v_cm / v0, " + name, result.error, 0.02);
    gates.at_most("energy drift over ten periods, " + name,
                  result.drift,
                  0.003);
    EXPECT_EQ(result.table["splits"].back(), n_splits) << name;
  }
} // namespace



// A Cauchy-stress law deviates from the linear solution by 1.1 % at this
// amplitude: no code gets below.
TEST(Bar, VelocityAndEnergyOverTenPeriods)
{
  Verification gates("Bar of the paper", "prm/bar.prm", source);
  const auto   split = run_ten_periods("split", {});
  hold(gates, "unsplit", run_ten_periods("unsplit", unsplit), 0);
  hold(gates, "split", split, 84);
  std::vector<double> exact;
  for (const double t : split.table["time [s]"])
    exact.push_back(0.2 / M_PI * std::cos(omega * t));
  Verification::write_series("bar",
                             {{"time [s]", split.table["time [s]"]},
                              {"talus", split.table["centre velocity x [m/s]"]},
                              {"closed form", exact}});
}



// The runs choose different steps, so each is compared with the exact solution
// at its own times.
TEST(Bar, SplittingDoesNotShowInTheVelocity)
{
  const Overrides short_run = {"End time=" + std::to_string(3. * period)};
  const auto      a =
    deviation(run<2>("bar.prm", "bar-a", short_run + unsplit), 0.1);
  const auto b = deviation(run<2>("bar.prm", "bar-b", short_run), 0.1);
  ASSERT_EQ(a.size(), b.size());
  std::vector<double> difference;
  for (unsigned int i = 0; i < a.size(); ++i)
    difference.push_back(a[i] - b[i]);
  Verification("Bar of the paper", "prm/bar.prm", "no splits")
    .at_most("v_cm / v0, split - unsplit", largest(difference), 1e-3);
  EXPECT_GT(largest(difference), 0.); // there was something to compare
}



// The strain v0/c cos(b x) sin(w t) passes beta - 1 where
// cos(b x) > 0.025 c/v0: x < 0.4196 L, first beside the fixed end at
// t = 4.59 s.
TEST(Bar, SplitsWhereAndWhenTheStrainSaysSo)
{
  Case<2> bar("bar.prm", {});
  double  first_split = 0;
  while (bar->state().time < period / 4. + 1.)
    {
      bar->advance();
      if (first_split == 0 && bar.points().size() > 200)
        first_split = bar->state().time;
    }
  const double exact =
    std::asin(0.025 * speed_of_sound / 0.1 / std::cos(M_PI / 50. * 0.125)) /
    omega;
  Verification gates("Bar of the paper", "prm/bar.prm", "linear closed form");
  gates.near("first split [s]", first_split, exact, 0.1 / exact);

  const Points<2> &points = bar.points();
  EXPECT_EQ(points.size(), 452u);
  const unsigned long n_splits = bar->scheme().splitter().statistics().n_splits;
  gates.holds("points that split, of 200",
              std::to_string(n_splits),
              "84, those with x < 0.4196 L",
              n_splits == 84);
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const double x = points.data(points.initial_position)[p];
      EXPECT_EQ(points.data(points.generation)[p], x < 0.4196 * length ? 1 : 0)
        << "x = " << x;
    }
}



// Boxes that follow the bar give the same, whatever the rule. Fixed boxes tile
// no children and do not follow the bar: all errors are up to 0.2 % larger.
TEST(Bar, OtherBoxRules)
{
  Verification gates("Bar of the paper",
                     "prm/bar.prm, Transfer/Box rule, Splitting/Shear",
                     source);
  const auto   reference = run_ten_periods("counted", {});
  const auto ignored = run_ten_periods("ignored", {"Splitting/Shear=ignored"});
  hold(gates, "split, shear ignored", ignored, 84);
  EXPECT_NEAR(ignored.error, reference.error, 1e-6);
  const auto fixed = run_ten_periods("fixed", {"Transfer/Box rule=fixed"});
  gates.at_most("error of v_cm / v0, split, fixed boxes", fixed.error, 0.02);
  EXPECT_LT(fixed.error, reference.error + 0.003);
  gates.falls_short("energy drift over ten periods, split, fixed boxes",
                    fixed.drift,
                    0.003,
                    {0.004,
                     "children of a box that does not follow its stretch do "
                     "not tile it"});
}



// With small amplitudes the free end passes a face of the cells to and fro, by
// next to nothing: the time step must be stable for nodes that hardly any soil
// touches.
TEST(Bar, EndOnAFaceOfTheCells)
{
  for (const unsigned int n : {1, 2})
    {
      SCOPED_TRACE(n);
      const Table table =
        run<2>("bar.prm",
               text("bar-on-face-", n),
               unsplit + Overrides{"End time=64",
                                   "Time step/CFL number=1",
                                   "Bodies/bar/Initial "
                                   "velocity=1e-3*sin(pi*x/50); 0",
                                   text("Bodies/bar/Points per cell and "
                                        "axis=",
                                        n)});
      const auto &elastic = table["elastic energy [J]"];
      const auto &kinetic = table["kinetic energy [J]"];
      for (unsigned int row = 0; row < table.n_rows(); ++row)
        EXPECT_NEAR((elastic[row] + kinetic[row]) / kinetic[0], 1., 0.02);
    }
}



// In the linear range the error is that of the method: second order. At the
// times of the rows, dt/2 after those of the velocities, an error of first
// order in dt adds up: that column is there for comparison.
TEST(BarConvergence, SecondOrderInTheCellSize)
{
  Refinement refinement("linear-bar"), at_rows("linear-bar-at-rows");
  const std::vector<double> known = {9.1e-2, 2.4e-2, 6.6e-3, 2.1e-3};
  for (const std::string h : {"2", "1", "0.5", "0.25"})
    {
      const Table table =
        run<2>("bar.prm",
               "bar-linear-" + h,
               unsplit +
                 Overrides{"Grid/Cell size=" + h,
                           "Grid/Upper corner=30," + h,
                           "Bodies/bar/Upper corner=25," + h,
                           "Bodies/bar/Initial velocity="
                           "0.001*sin(pi*x/50)*cos(pi/50*sqrt(10)*t); 0"});
      refinement.add(length / std::stod(h), largest(deviation(table, 0.001)));
      at_rows.add(length / std::stod(h), largest(deviation(table, 0.001, 1.)));
      EXPECT_LE(refinement.errors().back(),
                1.02 * known[refinement.errors().size() - 1]);
    }
  refinement.print();
  at_rows.print();
  Verification gates("Bar, v0 = 0.001 m/s",
                     "prm/bar.prm",
                     "linear closed form");
  gates.at_least("order of the error of v_cm, h = 2 to 0.25 m: " +
                   refinement.list(),
                 refinement.least_order(),
                 1.9,
                 "2");
}
