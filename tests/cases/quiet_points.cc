// SPDX-License-Identifier: LGPL-2.1-or-later
// Transfer/Scheme=filtered FLIP: points that rest with the grid, and a mean
// stress without noise, in the same slide.

#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  const Overrides filtered = {"Transfer/Scheme=filtered FLIP"};

  struct QuietResult
  {
    Table  table;
    double scatter = 0.; // of the mean stress of the points at the end, Pa
  };



  /// Root of the mean square of what the mean stress of the points differs from
  /// its mean over their cell, by volume, Pa.
  template <int dim>
  double
  scatter_of_mean_stress(const Points<dim> &points)
  {
    double       square = 0., total = 0.;
    const double third = 1. / 3.;
    points.for_each_cell(points.all(), [&](const Batch &cell) {
      double sum = 0., sum_of_squares = 0., volume = 0.;
      for (unsigned int p = cell.begin; p < cell.end; ++p)
        {
          const double V        = points.data(points.reference_volume)[p];
          double       pressure = 0.;
          for (unsigned int d = 0; d < 3; ++d)
            pressure += third * points.data(points.stress, d)[p];
          sum += V * pressure;
          sum_of_squares += V * pressure * pressure;
          volume += V;
        }
      square += sum_of_squares - sum * sum / volume;
      total += volume;
    });
    return std::sqrt(square / total);
  }



  template <int dim>
  QuietResult
  slide(const std::string &file,
        const std::string &name,
        const Overrides   &overrides)
  {
    const auto folder = std::filesystem::path(TALUS_RESULTS_DIR) / name;
    std::filesystem::remove_all(folder);
    Case<dim> slide(file,
                    Overrides{"Output/Write points=false",
                              "Output/Write grid=false",
                              "Output/Folder=" + folder.string(),
                              "Splitting/Directions=stretched",
                              "Splitting/Shear=ignored"} +
                      overrides);
    slide->run();
    QuietResult result;
    result.table   = Table(folder / "statistics.csv");
    result.scatter = scatter_of_mean_stress(slide.points());
    return result;
  }



  /// What the filter must not change, and what it must.
  void
  expect_same_slide(Verification      &gates,
                    const QuietResult &plain,
                    const QuietResult &quiet,
                    const double       end)
  {
    gates.at_most(
      "front, difference to FLIP",
      relative_difference(quiet.table, plain.table, "front x [m]", end),
      0.005);
    gates.at_most("scatter of the mean stress about that of the cell, over "
                  "FLIP's",
                  quiet.scatter / plain.scatter,
                  0.5);
    expect_momentum(gates, quiet.table);
  }
} // namespace



TEST(QuietPoints, LandslideAtRest)
{
  Verification      gates("Landslide, h = 0.5 m, filtered FLIP",
                     "prm/landslide-quick.prm, Grid/Cell size=0.5, "
                          "Splitting/Directions=stretched, "
                          "Transfer/Scheme=filtered FLIP",
                     "the slide by FLIP; balance of momentum and energy");
  const Overrides   coarse = {"Grid/Cell size=0.5"};
  const std::string file   = "landslide-quick.prm";
  const QuietResult plain  = slide<2>(file, "noisy-points", coarse);
  const QuietResult quiet  = slide<2>(file, "quiet-points", coarse + filtered);
  const double      later  = time_of_rest(quiet.table) + 3.;
  ASSERT_LE(later, 30.);
  double fastest = 0.;
  for (unsigned int i = 0; i < quiet.table.n_rows(); ++i)
    if (quiet.table["time [s]"][i] >= later)
      fastest =
        std::max(fastest, quiet.table["maximum speed of points [m/s]"][i]);
  gates.at_most("speed of points from 3 s after the grid rests [m/s]",
                fastest,
                0.05);
  expect_same_slide(gates, plain, quiet, 30.);
  expect_energy(gates, quiet.table, 0.002, 0.002);
  expect_continuum(gates, quiet.table);
}



TEST(QuietPoints, Landslide3d)
{
  Verification      gates("3-D landslide, h = 0.8 m, filtered FLIP",
                     "prm/landslide-3d.prm, Transfer/Scheme=filtered FLIP",
                     "the slide by FLIP");
  const std::string file  = "landslide-3d.prm";
  const QuietResult plain = slide<3>(file, "noisy-points-3d", {});
  const QuietResult quiet = slide<3>(file, "quiet-points-3d", filtered);
  expect_same_slide(gates, plain, quiet, 4.);
}
