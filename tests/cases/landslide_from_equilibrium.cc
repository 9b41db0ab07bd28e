// SPDX-License-Identifier: LGPL-2.1-or-later
// The landslide of the paper from equilibrium: strong soil in balance, whose
// strength falls to that of the paper, prm/landslide-trigger.prm.

#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double trigger = 2., later = 10.; // s



  /// Against the landslide that starts without stress, @p share is the gate of
  /// the front.
  void
  hold(const double h, const double share)
  {
    const Overrides cells = {text("Grid/Cell size=", h)};
    const Table     slide =
      run<2>("landslide-trigger.prm",
             text("landslide-from-equilibrium-", h),
             cells + Overrides{"Stages=equilibrium, dynamics",
                               text("End time=", trigger + later)});
    const Table  at_once = run<2>("landslide-quick.prm",
                                 text("landslide-at-once-", h),
                                 cells + Overrides{text("End time=", later)});
    Verification gates(text("The landslide of the paper from equilibrium, h = ",
                            h,
                            " m, to 10 s after the trigger"),
                       "prm/landslide-trigger.prm Stages = equilibrium, "
                       "dynamics",
                       "balance before the trigger; afterwards the landslide "
                       "that starts without stress");

    const auto &kinetic = slide["grid kinetic energy [J]"];
    const auto &work    = slide["gravity work [J]"];
    double      before = 0, remainder = 0;
    for (unsigned int i = 0; i < slide.n_rows(); ++i)
      {
        if (slide["time [s]"][i] < trigger)
          before = std::max(before, kinetic[i]);
        remainder =
          std::max(remainder, std::abs(slide["energy remainder [J]"][i]));
      }
    gates.at_most("kinetic energy before the trigger / at the end",
                  before / kinetic.back(),
                  1e-6);
    const double front = at_once.at(later, "front x [m]");
    gates.near("front [m]",
               slide.at(trigger + later, "front x [m]"),
               front,
               share);
    gates.at_most("|energy remainder| / final gravity work",
                  remainder / work.back(),
                  0.005);
    expect_momentum(gates, slide);
    expect_continuum(gates, slide);
  }
} // namespace



TEST(LandslideFromEquilibrium, Coarse)
{
  hold(0.8, 0.01);
}



TEST(LandslideFromEquilibriumFine, Cells)
{
  hold(0.4, 0.01);
}
