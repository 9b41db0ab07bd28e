// SPDX-License-Identifier: LGPL-2.1-or-later
// Soil that runs against a structure which stands in the bed: box-in-bed.prm.
// The surfaces of bed and structure end where they meet; soil must not get
// below the bed there. With facets that were dropped whole 12 to 14 % of it
// did, 2.7 cells deep.

#include "case.h"

#include <gtest/gtest.h>

using namespace talus::cases;

namespace
{
  const double end_time = 20.; // s

  /// Run the jet against the box with the bed at the height @p y, m, at its
  /// face.
  void
  expect_no_leak(const std::string &name,
                 const std::string &y,
                 const Overrides   &overrides = {})
  {
    SCOPED_TRACE(name);
    run<2>("box-in-bed.prm",
           name,
           Overrides{"Surfaces/b/Expression=" + y + " - 0.07*(x - 400)",
                     "Output/Statistics interval=1"} +
             overrides);
    const Table obstacles(std::filesystem::path(TALUS_RESULTS_DIR) / name /
                          "obstacles.csv");
    EXPECT_GE(obstacles["time [s]"].back(), end_time);
    // Of 1485 m^2.
    EXPECT_LT(obstacles["bed volume below surface [m^2]"].back(), 0.03 * 1485);
    EXPECT_LT(obstacles["bed deepest point [cells]"].back(), 0.5);
    EXPECT_GT(obstacles["box impulse x [N s]"].back(), 0.);
  }
} // namespace



// The bed above the middle of the cell, where the whole face of the box was
// dropped.
TEST(StructureInBed, KeepsSoilAboveTheBed)
{
  expect_no_leak("box-in-bed-6", "-2");
  expect_no_leak("box-in-bed-7", "-1.5");

  // Centres a hundredth of a cell below the surface are no soil within the bed.
  unsigned int n_shallow = 0;
  for (const std::string name : {"box-in-bed-6", "box-in-bed-7"})
    {
      const Table obstacles(std::filesystem::path(TALUS_RESULTS_DIR) / name /
                            "obstacles.csv");
      const std::vector<double> &depths =
        obstacles["bed deepest point [cells]"];
      const std::vector<double> &volumes =
        obstacles["bed volume below surface [m^2]"];
      for (unsigned int row = 0; row < depths.size(); ++row)
        if (depths[row] > 0. && depths[row] <= 0.1)
          {
            EXPECT_EQ(volumes[row], 0.);
            ++n_shallow;
          }
    }
  EXPECT_GT(n_shallow, 0u);
}



TEST(StructureInBed, WithADeepFoot)
{
  expect_no_leak("box-in-bed-deep",
                 "-2",
                 {"Obstacles/box/Lower corner=400,-42"});
}



// The bed and the box, both cut by a wall a tenth of a cell thick, which is a
// remark and no error: it must run.
TEST(StructureInBed, ThinWall)
{
  expect_no_leak("box-in-bed-wall",
                 "-2",
                 {"Obstacles/box/Lower corner=400,-15",
                  "Obstacles/box/Upper corner=400.5,10"});
}
