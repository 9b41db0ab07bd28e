// SPDX-License-Identifier: LGPL-2.1-or-later
// Infinite layers on a slope of 5 degrees: one that slides on a soft interface,
// prm/verification/shear-layer.prm, and two that flow, bingham-layer.prm and
// herschel-bulkley-layer.prm.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// Values at the points over their height, against a closed form. Written as
  /// the series @p name; returns the largest error.
  double
  error_of_profile(const Points<2>                             &points,
                   const std::string                           &name,
                   const double                                *values,
                   const std::function<double(const double y)> &exact)
  {
    std::vector<std::pair<double, unsigned int>> order;
    for (unsigned int p = 0; p < points.size(); ++p)
      order.emplace_back(points.data(points.position, 1)[p], p);
    std::sort(order.begin(), order.end());
    std::vector<double> height, found, known;
    double              error = 0;
    for (const auto &[y, p] : order)
      {
        height.push_back(y);
        found.push_back(values[p]);
        known.push_back(exact(y));
        error = std::max(error, std::abs(found.back() - known.back()));
      }
    Verification::write_series(
      name, {{"height", height}, {"talus", found}, {"closed form", known}});
    return error;
  }



  const double slope_sine = std::sin(M_PI / 36.);

  /// An infinite layer on a strip of this length, m.
  void
  expect_sliding_layer(const double length)
  {
    constexpr double H = 2., tau_max = 1000., rho = 1500.; // m, Pa, kg/m^3
    const auto       folder =
      std::filesystem::path(TALUS_RESULTS_DIR) / text("shear-layer-", length);
    const std::string upper = text(length, ", 2");
    const Overrides   strip = {"Output/Write points=false",
                               "Output/Write grid=false",
                               "Output/Folder=" + folder.string(),
                               text("Grid/Upper corner=", length, ", 2.5"),
                               "Bodies/layer/Upper corner=" + upper};
    const std::string file  = "verification/shear-layer.prm";
    Case<2>           layer(file, strip);
    layer->run();
    const Points<2> &points = layer.points();
    const double     stress =
      error_of_profile(points,
                       "shear-layer",
                       points.data(points.stress, stress_index<2>(0, 1)),
                       [=](const double y) { return tau_max * (1. - y / H); });
    const Table  table(folder / "statistics.csv");
    const double exact = 9.81 * slope_sine - tau_max / (rho * H);
    const double found =
      slope(table["time [s]"], table["centre velocity x [m/s]"], 0., 5.);
    Verification gates(text("Layer on a capped seabed, ", length, " m long"),
                       "prm/" + file,
                       "a = g sin - tau_max/(rho H), tau = tau_max (1 - y/H)");
    gates.at_most("acceleration, relative error",
                  std::abs(found / exact - 1.),
                  1e-11);
    gates.at_most("shear stress, largest error / tau_max",
                  stress / tau_max,
                  1e-11);
  }



  /// Where the points have come since the start, m, by their number. They move
  /// with the velocity of the grid, which does not see the noise of their own.
  std::vector<double>
  distances(const Points<2> &points)
  {
    std::vector<double> result(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      result.at(std::lround(points.data(points.id)[p])) =
        points.data(points.position)[p] -
        points.data(points.initial_position)[p];
    return result;
  }



  /// Steady flow with tau = tau_y + K gdot^n.
  void
  expect_steady_flow(const std::string &name, const double K, const double n)
  {
    const std::string file = "verification/" + name + "-layer.prm";
    Case<2>           layer(file, {"Output/Write points=false"});
    const double      end = (n < 1. ? 400. : 150.) - 1e-9;
    while (layer->state().time < end - 1.)
      layer->advance();
    const double              begin  = layer->state().time;
    const std::vector<double> before = distances(layer.points());
    while (layer->state().time < end)
      layer->advance();
    const std::vector<double> after  = distances(layer.points());
    const Points<2>          &points = layer.points();
    std::vector<double>       u(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto id = std::lround(points.data(points.id)[p]);
        u[p] = (after[id] - before[id]) / (layer->state().time - begin);
      }

    const double S = 600. * 9.81 * slope_sine, h_s = 5. - 1000. / S; // Pa/m, m
    const double m     = (n + 1.) / n;
    const auto   exact = [=](const double y) {
      return std::pow(S / K, 1. / n) / m *
             (std::pow(h_s, m) - std::pow(std::max(h_s - y, 0.), m));
    };
    // Shear by hundreds along the rows splits nothing.
    EXPECT_EQ(layer->scheme().splitter().statistics().n_splits, 0u);
    Verification gates((n < 1. ? "Herschel-Bulkley" : "Bingham") +
                         std::string(" layer on a slope"),
                       "prm/" + file,
                       "steady flow, closed form");
    gates.near("velocity of the surface [m/s]",
               *std::max_element(u.begin(), u.end()),
               exact(5.),
               0.005);
    gates.at_most("velocity, largest error over height / that of the surface",
                  error_of_profile(points, "layer-" + name, u.data(), exact) /
                    exact(5.),
                  0.005);
  }
} // namespace



TEST(ShearLayer, ThreeCells)
{
  expect_sliding_layer(0.75);
}



TEST(ShearLayer, OneCell)
{
  expect_sliding_layer(0.25);
}



TEST(ViscoplasticLayer, Bingham)
{
  expect_steady_flow("bingham", 300., 1.);
}



TEST(ViscoplasticLayer, HerschelBulkley)
{
  expect_steady_flow("herschel-bulkley", 500., 0.5);
}
