// SPDX-License-Identifier: LGPL-2.1-or-later
// The landslide of the paper in full: minutes to an hour.

#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double all_times = 30.; // s

  void
  expect_within(Verification      &gates,
                const std::string &name,
                const Table       &a,
                const Table       &b,
                const std::string &column,
                const double       end,
                const double       tolerance)
  {
    gates.at_most(text(name, ": ", column, ", difference to ", end, " s"),
                  relative_difference(a, b, column, end),
                  tolerance);
  }

  const std::string slow_source =
    "balance of momentum and energy; the paper's slide";
} // namespace



// Four-way and stretched splitting, beta 1.4 and 1.7.
TEST(LandslideFourWay, ToRestAndAgainstItsVariants)
{
  const std::string file = "landslide-quick.prm";
  Verification      gates("Landslide, h = 0.4 m", "prm/" + file, slow_source);
  const Table       four_way = shared_run("slide");
  expect_split_landslide(gates, four_way, 0.002);

  const Table stretched = shared_run("slide-stretched");
  expect_within(gates,
                "stretched against four-way splitting",
                stretched,
                four_way,
                "front x [m]",
                all_times,
                0.006);

  const Table later =
    run<2>(file, "landslide-beta-1.7", {"Splitting/Threshold=1.7"});
  expect_within(gates,
                "beta 1.7 against 1.4",
                later,
                four_way,
                "front x [m]",
                all_times,
                0.003);

  const Table merged =
    run<2>(file,
           "landslide-four-way-merged",
           {"Splitting/Merge=all", "Splitting/Shear=ignored"});
  gates.at_most("with merging: points at rest / at the start",
                merged["points"].back() / merged["points"].front(),
                2.);
  expect_within(gates,
                "four-way with merging against stretched splitting",
                merged,
                stretched,
                "front x [m]",
                all_times,
                0.003);
  gates.falls_short(
    "with merging: front x [m], difference to 30 s",
    relative_difference(merged, four_way, "front x [m]", 30.),
    0.003,
    {0.006,
     "merging brings the front to that of stretched splitting, from which that "
     "of four-way splitting differs by as much"});
}



// The paper's own resolution, about 45 minutes, and the same with coarse cells.
TEST(LandslideFull, ToRestAndAgainstCoarseCells)
{
  Verification gates("Landslide of the paper, h = 0.2 m",
                     "prm/landslide.prm",
                     slow_source);
  const Table  fine = run<2>("landslide.prm", "landslide-full");
  expect_split_landslide(gates, fine, 0.001);

  const std::string name   = "h = 0.4 against 0.2 m";
  const Table       coarse = shared_run("slide");
  expect_within(gates, name, coarse, fine, "front x [m]", all_times, 0.01);
  expect_within(gates, name, coarse, fine, "centre x [m]", 16., 0.01);
  expect_within(gates, name, coarse, fine, "centre x [m]", 20., 0.015);
  expect_within(gates, name, coarse, fine, "centre x [m]", all_times, 0.02);
}



TEST(LandslideFullUnsplit, Fractures)
{
  Verification gates("Landslide of the paper, h = 0.2 m, unsplit",
                     "prm/landslide.prm, Splitting/Enabled=false",
                     slow_source);
  const Table  table = run<2>("landslide.prm",
                             "landslide-full-unsplit",
                             {"Splitting/Enabled=false"});
  expect_momentum(gates, table);
  expect_energy(gates, table, 0.005, 0.005);
  expect_fracture(gates, table, 20);
}
