// SPDX-License-Identifier: LGPL-2.1-or-later
// Infinite layers on a slope of 5 degrees: one that slides on a soft interface,
// prm/verification/shear-layer.prm, and two that flow, bingham-layer.prm and
// herschel-bulkley-layer.prm; and a flow between walls with a film, channel.prm
// and channel-3d.prm.

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



  /// Flow between two walls, along the component @p x or y of the velocity.
  template <int dim>
  void
  expect_channel(const std::string &walls,
                 const std::string &component,
                 const Overrides   &overrides = {})
  {
    const std::string file  = dim == 2 ? "channel.prm" : "channel-3d.prm";
    const Table       table = run<dim>(file, "channel-" + walls, overrides);
    constexpr double  f = 1000., mu = 100., K = 500.; // N/m^3, Pa s, Pa (s/m)^n
    Verification      gates("Channel between walls with a film, " + walls,
                       "tests/cases/" + file,
                       "u = f H^2/(12 mu) + b (f H/(2 K))^(1/n)");
    gates.near("mean velocity [m/s]",
               table["centre velocity " + component + " [m/s]"].back(),
               f / (12. * mu) + std::pow(f / (2. * K), 2),
               0.01);
  }
} // namespace



TEST(Channel, FacesAlongX)
{
  expect_channel<2>("faces along x", "y");
}



TEST(Channel, FacesAlongY)
{
  expect_channel<2>("faces along y",
                    "x",
                    {"Grid/Upper corner=0.125, 1",
                     "Bodies/mud/Upper corner=0.125, 1",
                     "Body force/Expression=1; 12*(y-0.5)",
                     "Boundaries/Left=periodic",
                     "Boundaries/Right=periodic",
                     "Boundaries/Bottom=seabed",
                     "Boundaries/Top=seabed"});
}



TEST(Channel, FacesAlongZ)
{
  expect_channel<3>("faces along z", "x");
}



// The surfaces lie in the middle of cells.
TEST(Channel, Obstacles)
{
  Overrides walls = {"Grid/Lower corner=-0.1875, 0",
                     "Grid/Upper corner=1.1875, 0.125",
                     "Boundaries/Left=free",
                     "Boundaries/Right=free",
                     "Obstacles/Names=left, right",
                     "Obstacles/left/Normal=1, 0",
                     "Obstacles/right/Normal=-1, 0",
                     "Obstacles/right/Point=1, 0"};
  for (const std::string wall : {"left", "right"})
    for (const std::string entry : {"Shape=half-plane",
                                    "Friction coefficient=0",
                                    "Maximum shear stress=0",
                                    "Film consistency=500",
                                    "Film exponent=0.5",
                                    "Film thickness=1"})
      walls.push_back(text("Obstacles/", wall, '/', entry));
  expect_channel<2>("obstacles", "y", walls);
}



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
