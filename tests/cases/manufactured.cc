// Mesh refinement against a manufactured solution, manufactured-bar.prm.

#include "case.h"

#include <talus/base/errors.h>

#include <deal.II/base/convergence_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double wave_speed = 100.; // m/s

  /// sqrt(sum V0 (u - u_exact)^2 / sum V0) now, m.
  double
  displacement_error(const Points<2> &points, const double t)
  {
    double sum = 0, volume = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double V0 = points.data(points.reference_volume)[p];
        const double X  = points.data(points.initial_position)[p];
        const double u  = points.data(points.position)[p] - X;
        const double exact =
          0.05 * std::sin(M_PI * X) * std::sin(wave_speed * M_PI * t);
        sum += V0 * (u - exact) * (u - exact);
        volume += V0;
      }
    return std::sqrt(sum / volume);
  }



  /// Largest error of all steps.
  double
  run_with_cells(const unsigned int n, const std::string &rule)
  {
    const double      dt = 0.2 / n / wave_speed;
    const std::string h  = text(1. / n);
    Case<2>           bar("manufactured-bar.prm",
                {"Grid/Cell size=" + h,
                           "Grid/Upper corner=1," + h,
                           "Bodies/bar/Upper corner=1," + h,
                           text("Time step/Maximum=", dt),
                           "Transfer/Box rule=" + rule});
    EXPECT_EQ(bar.points().size(), 4 * n);
    double error = 0;
    for (unsigned int step = 0; step < std::lround(0.02 / dt); ++step)
      {
        bar->advance();
        const double now =
          displacement_error(bar.points(), bar->snapshot().time);
        error = (now <= error ? error : now);
      }
    EXPECT_NEAR(bar->snapshot().time, 0.02, 1e-9);
    return error;
  }



  std::vector<double>
  refine(const std::string &rule, const std::vector<unsigned int> &cells)
  {
    dealii::ConvergenceTable convergence;
    std::vector<double>      errors;
    for (const unsigned int n : cells)
      {
        errors.push_back(run_with_cells(n, rule));
        convergence.add_value("cells", n);
        convergence.add_value("error [m]", errors.back());
      }
    convergence.set_scientific("error [m]", true);
    convergence.evaluate_convergence_rates(
      "error [m]", dealii::ConvergenceTable::reduction_rate_log2);
    std::cout << "Box rule " << rule << ":\n";
    convergence.write_text(std::cout);
    return errors;
  }
} // namespace



TEST(ManufacturedBar, SecondOrder)
{
  const auto                errors = refine("right stretch", {8, 16, 32, 64});
  const std::vector<double> known  = {6.45e-3, 1.61e-3, 4.01e-4, 1.01e-4};
  for (unsigned int i = 0; i < errors.size(); ++i)
    EXPECT_NEAR(errors[i], known[i], 0.15 * known[i]);
  for (unsigned int i = 1; i < errors.size(); ++i)
    EXPECT_GE(std::log2(errors[i - 1] / errors[i]), 1.9);
}



// The control: boxes that do not follow F leave gaps and overlaps, and the
// error stalls. Were it not so, the test above would not see the boxes.
TEST(ManufacturedBar, FixedBoxesStall)
{
  const auto errors = refine("fixed", {32, 64, 128});
  EXPECT_LT(std::log2(errors[1] / errors[2]), 0.);
  EXPECT_NEAR(errors[2], 4e-4, 0.5e-4);
}
