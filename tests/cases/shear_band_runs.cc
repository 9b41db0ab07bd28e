// SPDX-License-Identifier: LGPL-2.1-or-later
// Shear bands in motion: prm/verification/shear-band.prm with a zone that loses
// strength slowly, and prm/slab-failure.prm.

#include "case.h"
#include "verification.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace shear_band_runs_test
{
  constexpr double wave_speed = 58.6; // of the slab, sqrt(E'/rho), m/s



  /// What became of a zone of length @p L, m, after @p end, s.
  struct Band
  {
    double energy;  ///< kinetic, J
    double yielded; ///< length of the weak row, m
    double growth;  ///< largest, m/s
  };

  Band
  band(const double L, const double end)
  {
    const std::string name = text("shear-band-runs-", L);
    const Table       statistics =
      run<2>("verification/shear-band.prm",
             name,
             {"Stages=dynamics",
              text("End time=", end),
              "Materials/zone/Undrained shear strength=3500",
              "Trigger/Bodies=zone",
              "Trigger/Duration=12",
              "Trigger/Strength fraction=0.428571428571",
              "Bodies/slab/Points per cell and axis=1",
              "Bodies/zone/Points per cell and axis=1",
              "Bodies/weak/Points per cell and axis=1",
              text("Bodies/zone/Upper corner=", L, ", 0.5"),
              text("Bodies/weak/Lower corner=", L, ", 0")});
    const Table bands(std::filesystem::path(TALUS_RESULTS_DIR) / name /
                      "bands.csv");
    const auto &growth = bands["growth of the yielded length of weak [m/s]"];
    return {statistics["grid kinetic energy [J]"].back(),
            bands["yielded length of weak [m]"].back(),
            *std::max_element(growth.begin(), growth.end())};
  }



  // The length is by columns of cells, and some yield by overshoot.
  TEST(ShearBandRuns, StandsBelowTheCriticalLength)
  {
    Verification gates("Shear band from a zone of 41 m, in motion",
                       "prm/verification/shear-band.prm, Trigger",
                       "L_cr = 46.02 m; 1-D theory of the state in balance");
    const Band   found = band(41., 20.);
    gates.at_most("kinetic energy at 20 s [J]", found.energy, 1.);
    gates.near("yielded length beyond the zone [m]", found.yielded, 47., 0.064);
  }



  TEST(ShearBandRuns, RunsAwayBeyondTheCriticalLength)
  {
    Verification gates("Shear band from a zone of 51 m, in motion",
                       "prm/verification/shear-band.prm, Trigger, longer zone",
                       "L_cr = 46.02 m; no tip is faster than sqrt(E'/rho)");
    const Band   found = band(51., 20.);
    gates.at_least("kinetic energy at 20 s [J]", found.energy, 1e5, "> 1e5");
    gates.at_least("yielded length beyond the zone [m]",
                   found.yielded,
                   169.,
                   "169, all");
    gates.at_most("speed of a tip [m/s]",
                  0.5 * found.growth,
                  wave_speed,
                  text("< ", wave_speed));
    gates.at_least("speed of a tip [m/s]",
                   0.5 * found.growth,
                   0.5 * wave_speed,
                   "0.8 of the wave speed in a long band");
  }



  /// Displacement of the slab above the middle of the zone, m.
  double
  displacement(const Points<2> &points)
  {
    const double *x   = points.data(points.position);
    const double *X   = points.data(points.initial_position);
    const double *Y   = points.data(points.initial_position, 1);
    double        sum = 0.;
    unsigned int  n   = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      if (std::abs(X[p]) < 1. && Y[p] > 1.)
        {
          sum += x[p] - X[p];
          ++n;
        }
    return sum / n;
  }



  TEST(SlabFailure, DoesNotDependOnTheCells)
  {
    Verification gates("Slab failure, displacement above the zone",
                       "prm/slab-failure.prm, Cell size = 1, 0.5",
                       "on cells of h and h/2");
    std::map<double, std::vector<double>> found;
    const std::vector<double>             times = {24., 40., 46.};
    for (const double h : {1., 0.5})
      {
        Case<2> slab("slab-failure.prm",
                     {text("End time=", times.back()),
                      text("Grid/Cell size=", h)});
        for (const double time : times)
          {
            while (slab->state().time < time)
              slab->advance();
            found[h].push_back(displacement(slab.points()));
          }
      }
    gates.falls_short("relative difference at 24 s",
                      std::abs(found[1.][0] / found[0.5][0] - 1.),
                      0.05,
                      {0.09,
                       "the band reaches the ends of the layer at 10.25 s "
                       "and the slab breaks at 14.0 s on both meshes, but "
                       "the slide then starts faster on the smaller cells; "
                       "the cause is not known"});
    for (unsigned int i = 1; i < times.size(); ++i)
      gates.near(text("at ", times[i], " s [m]"),
                 found[1.][i],
                 found[0.5][i],
                 0.05);
  }
} // namespace shear_band_runs_test
