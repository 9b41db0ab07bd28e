// SPDX-License-Identifier: LGPL-2.1-or-later
// A shear band that grows from a weak zone below a slab, in balance:
// prm/verification/shear-band.prm.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace talus;
using namespace talus::cases;

namespace shear_band_test
{
  const std::string file   = "verification/shear-band.prm";
  constexpr double  d      = 0.05;  // softening displacement, m
  constexpr double  L_cr   = 46.02; // critical length, m
  const std::string source = "L_cr = 2 (1 - r)/r l_u, and int (tau - tau_g) du";



  /// A zone of length @p L, m.
  Overrides
  zone(const double L)
  {
    return {text("Bodies/zone/Upper corner=", L, ", 0.5"),
            text("Bodies/weak/Lower corner=", L, ", 0")};
  }



  Overrides
  cells(const double h)
  {
    return {text("Grid/Cell size=", h)};
  }



  /// Softening by strain as on cells of 0.5 m.
  const Overrides by_strain = {"Materials/weak/Softening displacement=",
                               "Materials/weak/Hardening modulus=-60e3"};



  /// Plastic slip across the row beside the zone at @p L, m: the sum over the
  /// cells of the row, whose points have the mean softening of the cell.
  double
  slip_at_edge(const Points<2> &points, const double L)
  {
    std::map<std::pair<long, double>, std::pair<double, double>> cells;
    const double *softening = points.data(points.find("softening"));
    const double *size      = points.data(points.find("cell size"));
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto x = load_place(points, points.position, p);
        if (points.data(points.body)[p] != 2 || x[0] < L ||
            x[0] > L + size[p] + 1e-9)
          continue;
        auto &[sum, n] = cells[{std::lround(std::floor(x[1] / size[p])),
                                std::round(x[0] / 1e-6)}];
        sum += softening[p];
        n += 1.;
      }
    std::map<double, double> of_column;
    for (const auto &[place, mean] : cells)
      of_column[place.second] += d * mean.first / mean.second;
    double slip = 0.;
    for (const auto &[x, u] : of_column)
      slip = std::max(slip, u);
    return slip;
  }



  /// What became of a zone beyond the critical length.
  struct Failure
  {
    double      share = 1.; ///< of the load, in the last balance
    std::string words;      ///< of the error, empty if there was a balance
  };

  Failure
  fail(const std::string &name, const Overrides &overrides)
  {
    Failure failure;
    Case<2> band(file,
                 Overrides{"Output/Folder=" + std::string(TALUS_RESULTS_DIR) +
                           '/' + name} +
                   overrides);
    try
      {
        band->run();
      }
    catch (const ExcUser &error)
      {
        failure.words = error.what();
      }
    failure.share = band->static_stages().equilibrium().load();
    return failure;
  }



  TEST(ShearBand, BalanceBelowTheCriticalLength)
  {
    Verification gates("Shear band from a zone of 41 m",
                       "prm/verification/shear-band.prm",
                       source);
    const std::map<std::string, Overrides> meshes = {
      {"h = 0.5 m", cells(0.5)},
      {"h = 0.25 m", cells(0.25)},
      {"h = 0.5 m, 0.25 m around the zone's end",
       cells(0.5) + Overrides{"Grid/Refinement boxes=30, 0; 52, 1; 1"}}};
    for (const auto &[mesh, overrides] : meshes)
      {
        const StaticCase<2> band(file, "shear-band", overrides);
        gates.near("plastic slip at the zone's end [m], " + mesh,
                   slip_at_edge(band.points(), 41.),
                   0.0124,
                   0.03);
      }
  }



  TEST(ShearBand, NoBalanceBeyondTheCriticalLength)
  {
    Verification gates("Shear band from a zone of 51 m",
                       "prm/verification/shear-band.prm, longer zone",
                       "L_cr/L = " + text(L_cr / 51.));
    for (const double h : {0.5, 0.25})
      {
        const auto failure = fail("shear-band-fails", zone(51.) + cells(h));
        gates.near(text("share of the load with a balance, h = ", h, " m"),
                   failure.share,
                   L_cr / 51.,
                   0.015 / 0.902);
        EXPECT_NE(failure.words.find("Softening is a cause"), std::string::npos)
          << failure.words;
        EXPECT_NE(failure.words.find("m of 'weak'"), std::string::npos);
      }
  }



  TEST(ShearBand, StrainDependsOnTheCells)
  {
    Verification gates("Shear band from a zone of 41 m, softening by strain",
                       "prm/verification/shear-band.prm, Hardening modulus",
                       "L_cr = 46.02 m on cells of 0.5 m, 32.5 m on 0.25 m");
    for (const double h : {0.5, 0.25})
      {
        const auto failure = fail("shear-band-by-strain", by_strain + cells(h));
        gates.holds(text("on cells of ", h, " m"),
                    failure.words.empty() ? "balance" : "no balance",
                    h == 0.5 ? "balance" : "no balance",
                    failure.words.empty() == (h == 0.5));
      }
  }



  TEST(ShearBand, FactorOfSafety)
  {
    Verification gates("Slope with a weak zone that softens: factor of safety",
                       "prm/verification/shear-band.prm, strength reduction",
                       "L_cr(F) = L with strengths over F");
    for (const auto &[L, exact, tolerance] :
         {std::array<double, 3>{{41., 1.0246, 0.005}},
          std::array<double, 3>{{30., 1.0883, 0.01}}})
      {
        const StaticCase<2> band(file,
                                 "shear-band-safety",
                                 zone(L) +
                                   Overrides{"Stages=equilibrium, strength "
                                             "reduction"});
        gates.near(text("factor of safety, L = ", L, " m"),
                   band.factor_of_safety(),
                   exact,
                   tolerance / exact);
      }
  }
} // namespace shear_band_test
