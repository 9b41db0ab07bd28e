// SPDX-License-Identifier: LGPL-2.1-or-later
// Failures of the scarp of a slide in sensitive clay, on two meshes:
// prm/verification/retrogression.prm.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace retrogression_test
{
  constexpr double height = 5.; // of the slope, m



  /// Retrogression of the scarp.
  struct Slide
  {
    double       distance;   ///< from the crest of the slope, m
    unsigned int n_failures; ///< failures of the scarp, the first included
  };



  /// Place of the scarp in each row of profile.csv, m: the surface has fallen
  /// by a tenth of the height.
  std::vector<double>
  scarp(const Table &profile)
  {
    const auto              &time    = profile["time [s]"];
    const auto              &x       = profile["x [m]"];
    const auto              &highest = profile["highest [m]"];
    std::map<double, double> place;
    for (unsigned int i = 0; i < time.size(); ++i)
      if (highest[i] < 0.9 * height)
        {
          const auto [entry, is_new] = place.emplace(time[i], x[i]);
          entry->second              = std::min(entry->second, x[i]);
        }
    std::vector<double> result;
    for (const auto &[t, x] : place)
      result.push_back(x);
    return result;
  }



  // In a failure the scarp retreats by more than half the height within two
  // rows, 1 s. In between it crumbles by a cell now and then.
  Slide
  slide(const double h, const Overrides &overrides)
  {
    const std::string name = text("retrogression-", h);
    run<2>("verification/retrogression.prm",
           name,
           overrides + Overrides{text("Grid/Cell size=", h)});
    const auto place = scarp(
      Table(std::filesystem::path(TALUS_RESULTS_DIR) / name / "profile.csv"));
    unsigned int n     = 0;
    bool         fails = false;
    for (unsigned int i = 2; i < place.size(); ++i)
      {
        const double retreat = place[i - 2] - place[i];
        n += !fails && retreat > 0.5 * height;
        fails = retreat > (fails ? 0.2 : 0.5) * height;
      }
    return {-place.back(), n};
  }



  TEST(Retrogression, DisplacementOrStrainOnSmallerCells)
  {
    Verification gates("Retrogression in sensitive clay, h = 0.5 and 0.25 m",
                       "prm/verification/retrogression.prm",
                       "on cells of h and h/2");
    // The strain that the displacement of 0.125 m is on cells of 0.5 m.
    const Overrides by_strain = {"Materials/clay/Softening displacement=",
                                 "Materials/clay/Hardening modulus=-192e3"};

    const Slide coarse = slide(0.5, {}), fine = slide(0.25, {});
    gates.holds("failures with the displacement kept",
                text(fine.n_failures),
                text(coarse.n_failures),
                fine.n_failures == coarse.n_failures);
    gates.near("retrogression with the displacement kept [m]",
               fine.distance,
               coarse.distance,
               0.15);
    const Slide strain = slide(0.25, by_strain);
    gates.holds("failures with the strain kept",
                text(strain.n_failures),
                text("not ", coarse.n_failures),
                strain.n_failures != coarse.n_failures);
    gates.at_least("retrogression with the strain kept [m]",
                   strain.distance,
                   1.3 * coarse.distance,
                   text("not ", coarse.distance));
  }
} // namespace retrogression_test
