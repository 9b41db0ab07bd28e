// The bar of the paper: axial vibration in the first mode, prm/bar.prm.
// u = (v0/w) sin(w t) sin(b x), b = pi/(2 L), w = b c, c = sqrt(E/rho), so that
// the centre of mass moves with (2 v0/pi) cos(w t).

#include "case.h"

#include <deal.II/base/convergence_table.h>

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

  /// (v_cm - exact)/v0 at each row. A velocity lives half a step before the time
  /// of its row: @p at is its place within the step.
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



  /// Ten periods, and what is expected of them whatever the box rule. Returns
  /// the error in v_cm.
  double
  run_ten_periods(const std::string &name,
                  const Overrides   &overrides,
                  const double       least_splits,
                  const double       most_splits,
                  const double       most_drift)
  {
    const Table  table = run<2>("bar.prm", "bar-" + name, overrides);
    const double error = largest(deviation(table, 0.1));
    const double drift = energy_drift(table);
    std::cout << "bar, " << name << ": error in v_cm " << 100 * error << " % ("
              << 100 * largest(deviation(table, 0.1, 1.))
              << " % at the time of the rows), energy drift " << 100 * drift
              << " %, splits " << table["splits"].back() << '\n';
    EXPECT_GE(table["time [s]"].back(), 10. * period - 1e-3);
    EXPECT_LT(error, 0.02) << name;
    EXPECT_LT(drift, most_drift) << name;
    EXPECT_GE(table["splits"].back(), least_splits) << name;
    EXPECT_LE(table["splits"].back(), most_splits) << name;
    EXPECT_LE(table["split ledger [-]"].back(), 1e-12) << name;
    return error;
  }
} // namespace



// A Cauchy-stress law deviates from the linear solution by 1.1 % at this
// amplitude: no code gets below.
TEST(Bar, VelocityAndEnergyOverTenPeriods)
{
  run_ten_periods("unsplit", unsplit, 0, 0, 0.003);
  run_ten_periods("split", {}, 84, 84, 0.003);
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
  std::cout << "bar: split - unsplit " << 100 * largest(difference) << " %\n";
  EXPECT_LT(largest(difference), 1e-3);
  EXPECT_GT(largest(difference), 0.); // there was something to compare
}



// The strain v0/c cos(b x) sin(w t) passes beta - 1 where cos(b x) > 0.025 c/v0:
// x < 0.4196 L, first beside the fixed end at t = 4.59 s.
TEST(Bar, SplitsWhereAndWhenTheStrainSaysSo)
{
  Case<2> bar("bar.prm", {});
  double  first_split = 0;
  while (bar->snapshot().time < period / 4. + 1.)
    {
      bar->advance();
      if (first_split == 0 && bar.points().size() > 200)
        first_split = bar->snapshot().time;
    }
  const double exact =
    std::asin(0.025 * speed_of_sound / 0.1 / std::cos(M_PI / 50. * 0.125)) /
    omega;
  std::cout << "bar: first split at " << first_split << " s, expected " << exact
            << " s\n";
  EXPECT_NEAR(first_split, exact, 0.1);

  const Points<2> &points = bar.points();
  EXPECT_EQ(points.size(), 452u);
  EXPECT_EQ(bar->snapshot().splits.n_splits, 84u);
  for (unsigned int p = 0; p < points.size(); ++p)
    {
      const double x = points.data(points.initial_position)[p];
      EXPECT_EQ(points.data(points.generation)[p], x < 0.4196 * length ? 1 : 0)
        << "x = " << x;
    }
}



// Boxes that follow the bar give the same, whatever the rule.
TEST(Bar, OtherBoxRules)
{
  const double reference = run_ten_periods("right stretch", {}, 84, 84, 0.003);
  for (const std::string rule : {"deformation gradient", "left stretch"})
    EXPECT_NEAR(
      run_ten_periods(rule, {"Transfer/Box rule=" + rule}, 84, 84, 0.003),
      reference,
      1e-6);
}



// Fixed boxes tile no daughters and do not follow the bar: all errors are up to
// 0.2 % larger than those of the unsplit bar with boxes that follow.
TEST(Bar, FixedBoxes)
{
  const Overrides fixed     = {"Transfer/Box rule=fixed"};
  const double    reference = run_ten_periods("unsplit", unsplit, 0, 0, 0.003);
  const double    split     = run_ten_periods("fixed", fixed, 84, 84, 0.005);
  EXPECT_LT(split, reference + 0.002);
}



// In the linear range the error is that of the method: second order. At the
// times of the rows, dt/2 after those of the velocities, an error of first order
// in dt adds up: that column is there for comparison.
TEST(BarConvergence, SecondOrderInTheCellSize)
{
  dealii::ConvergenceTable convergence;
  std::vector<double>      errors, at_rows;
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
      errors.push_back(largest(deviation(table, 0.001)));
      at_rows.push_back(largest(deviation(table, 0.001, 1.)));
      convergence.add_value("error at rows", at_rows.back());
      convergence.add_value("h [m]", std::stod(h));
      convergence.add_value("error in v_cm", errors.back());
    }
  convergence.set_scientific("error in v_cm", true);
  convergence.evaluate_convergence_rates(
    "error in v_cm", dealii::ConvergenceTable::reduction_rate_log2);
  convergence.write_text(std::cout);
  const std::vector<double> known = {9.1e-2, 2.4e-2, 6.6e-3, 2.1e-3};
  for (unsigned int i = 0; i < errors.size(); ++i)
    EXPECT_LE(errors[i], 1.02 * known[i]);
  for (unsigned int i = 1; i < errors.size(); ++i)
    EXPECT_GE(std::log2(errors[i - 1] / errors[i]), 1.9);
}
