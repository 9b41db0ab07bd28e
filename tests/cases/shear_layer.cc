// An infinite layer slides on a soft interface, prm/verification/shear-layer.prm.

#include "case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double H = 2., tau_max = 1000., rho = 1500.; // m, Pa, kg/m^3

  /// Largest |sigma_xy - tau_max (1 - y/H)| of the points, of tau_max.
  double
  error_of_shear_stress(const Points<2> &points)
  {
    double error = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double y   = points.data(points.position, 1)[p];
        const double tau = points.data(points.stress, stress_index<2>(0, 1))[p];
        error = std::max(error, std::abs(tau - tau_max * (1. - y / H)));
      }
    return error / tau_max;
  }



  /// Acceleration and shear stress on a strip of this length, m.
  void
  expect_closed_form(const double length)
  {
    const std::string name  = "shear-layer-" + std::to_string(length);
    const Overrides   strip = {
        "Output/Write points=false",
        "Output/Write grid=false",
        "Output/Folder=" + std::string(TALUS_RESULTS_DIR) + "/" + name,
        "Grid/Upper corner=" + std::to_string(length) + ", 2.5",
        "Bodies/layer/Upper corner=" + std::to_string(length) + ", 2"};
    Case<2> layer("verification/shear-layer.prm", strip);
    layer->run();
    const double stress = error_of_shear_stress(layer.points());
    const Table  table(std::filesystem::path(TALUS_RESULTS_DIR) / name /
                      "statistics.csv");
    const double exact = 9.81 * std::sin(M_PI / 36.) - tau_max / (rho * H);
    const double found =
      slope(table["time [s]"], table["centre velocity x [m/s]"], 0., 5.);
    std::cout << "shear layer, " << length << " m: error of the acceleration "
              << std::abs(found / exact - 1.) << ", of the shear stress "
              << stress << " of tau_max\n";
    EXPECT_NEAR(found, exact, 1e-11 * exact);
    EXPECT_LT(stress, 1e-11);
  }
} // namespace



TEST(ShearLayer, ThreeCells)
{
  expect_closed_form(0.75);
}



TEST(ShearLayer, OneCell)
{
  expect_closed_form(0.25);
}
