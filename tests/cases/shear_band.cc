// SPDX-License-Identifier: LGPL-2.1-or-later
// A shear band that grows from a weak zone below a slab, in balance:
// prm/verification/shear-band.prm.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <array>

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



  /// Plastic slip across the row of 0.5 m beside the zone that ends at @p L, m:
  /// the mean over 0.5 m of the sum over the cells one above the other.
  double
  slip_at_edge(const Points<2> &points, const double L)
  {
    constexpr double       height    = 0.5;
    constexpr unsigned int weak      = 2; // body
    const double          *softening = points.data(points.find("softening"));
    const double          *size      = points.data(points.find("cell size"));
    double                 sum       = 0.;
    unsigned int           n         = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double x = points.data(points.position)[p];
        if (points.data(points.body)[p] != weak || x < L || x > L + height)
          continue;
        sum += d * softening[p] * height / size[p];
        ++n;
      }
    return sum / n;
  }



  /// The zone of 41 m away from the ends of the mesh, with a finer mesh around
  /// its upper end: periodic faces do not allow cells of several sizes.
  const Overrides graded = {"Bodies/Names=slab, zone, weak, left",
                            "Boundaries/Left=roller",
                            "Boundaries/Right=roller",
                            "Bodies/zone/Lower corner=60, 0",
                            "Bodies/zone/Upper corner=101, 0.5",
                            "Bodies/weak/Lower corner=101, 0",
                            "Bodies/left/Shape=box",
                            "Bodies/left/Lower corner=0, 0",
                            "Bodies/left/Upper corner=60, 0.5",
                            "Bodies/left/Material=weak",
                            "Bodies/left/K0=1",
                            "Grid/Refinement boxes=95, 0; 110, 1; 1"};

  /// One point per cell in all bodies.
  const Overrides one_point = {"Bodies/slab/Points per cell and axis=1",
                               "Bodies/zone/Points per cell and axis=1",
                               "Bodies/weak/Points per cell and axis=1"};



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
    // A row of one cell has one point per cell and axis: with two, the slip is
    // 3.4 % more. A row of two cells has two: with one, every second cell
    // slips.
    const auto hold = [&](const std::string &mesh,
                          const Overrides   &overrides,
                          const double       end) {
      const StaticCase<2> band(file, "shear-band", overrides);
      gates.near("plastic slip at the zone's end [m], " + mesh,
                 slip_at_edge(band.points(), end),
                 0.0124,
                 0.03);
    };
    hold("h = 0.5 m", one_point, 41.);
    hold("h = 0.25 m", cells(0.25), 41.);
    hold("h = 0.5 m, 0.25 m around the end", graded, 101.);
  }



  /// A zone of 51 m on cells of size @p h, m, is beyond the critical length.
  void
  expect_failure(const double h)
  {
    Verification gates(text("Shear band from a zone of 51 m, h = ", h, " m"),
                       "prm/verification/shear-band.prm, longer zone",
                       "L_cr/L = " + text(L_cr / 51.));
    const auto   failure = fail("shear-band-fails", zone(51.) + cells(h));
    gates.near("share of the load with a balance",
               failure.share,
               L_cr / 51.,
               0.015 / 0.902);
    EXPECT_NE(failure.words.find("Softening: "), std::string::npos)
      << failure.words;
    EXPECT_NE(failure.words.find("m of 'weak'"), std::string::npos);
  }



  TEST(ShearBand, NoBalanceBeyondTheCriticalLength)
  {
    expect_failure(0.5);
  }



  TEST(ShearBandFine, NoBalanceBeyondTheCriticalLength)
  {
    expect_failure(0.25);
  }



  TEST(ShearBandFine, StrainDependsOnTheCells)
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
