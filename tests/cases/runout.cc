// SPDX-License-Identifier: LGPL-2.1-or-later
// runout.csv of stiff blocks that slide in any direction: the way of a rigid
// block, a t^2 / 2.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

// A namespace of its own: several files are compiled as one.
namespace runout_test
{
  namespace
  {
    Table
    runout_of(const std::string &name)
    {
      return Table(std::string(TALUS_RESULTS_DIR) + "/" + name + "/runout.csv");
    }



    /// Largest distance of runout and way of the centre, m.
    double
    largest_difference(const Table &table)
    {
      double result = 0;
      for (unsigned int i = 0; i < table.n_rows(); ++i)
        result = std::max(result,
                          std::abs(table["runout [m]"][i] -
                                   table["centre along path [m]"][i]));
      return result;
    }
  } // namespace



  TEST(Runout, IsTheSameToTheLeftAndToTheRight)
  {
    const std::string file = "verification/block-on-incline.prm";
    const Overrides right{"Grid/Lower corner=-3, 0", "Grid/Upper corner=5, 2"};
    run<2>(file, "runout-right", right);
    run<2>(file,
           "runout-left",
           {"Gravity/Slope angle=-30",
            "Grid/Lower corner=-3, 0",
            "Grid/Upper corner=5, 2"});
    const Table to_right = runout_of("runout-right"),
                to_left  = runout_of("runout-left");
    Verification gates("Block that slides to the left",
                       "prm/" + file + ", Gravity/Slope angle=-30",
                       "to the right");
    for (const std::string column :
         {"runout [m]", "centre along path [m]", "speed of the centre [m/s]"})
      gates.near(column + " at the end",
                 to_left[column].back(),
                 to_right[column].back(),
                 1e-9);
    gates.at_most("runout - way of the centre [cells]",
                  largest_difference(to_left) / 0.25,
                  1.);
  }



  TEST(Runout, FollowsTheSlope3d)
  {
    run<3>("block-downhill-3d.prm", "runout-3d");
    const Table  table = runout_of("runout-3d");
    const double angle = M_PI / 9., mu = 0.1;
    const double acceleration =
      9.81 * (std::sin(angle) - mu * std::cos(angle)) * std::cos(angle);
    Verification gates("Block that slides to the west-north-west",
                       "tests/cases/block-downhill-3d.prm",
                       "a t^2 / 2 in plan");
    gates.near("way of the centre in plan [m]",
               table["centre along path [m]"].back(),
               0.5 * acceleration * 4.,
               0.03);
    gates.near("speed of the centre in plan [m/s]",
               table["speed of the centre [m/s]"].back(),
               acceleration * 2.,
               0.03);
    gates.at_most("runout - way of the centre [cells]",
                  largest_difference(table) / 0.5,
                  1.5);
  }



  // The lower of two blocks leaves the mesh: the centre of mass of the soil
  // moves back up the slope, and the way of the slide must not turn back.
  TEST(Runout, DoesNotTurnWhereSoilLeaves)
  {
    const std::string file = "verification/block-on-incline.prm";
    run<2>(file,
           "runout-outflow",
           {"Grid/Lower corner=-8, 0",
            "Grid/Upper corner=8, 2",
            "Boundaries/Right=outflow",
            "Bodies/Names=block, lower",
            "Bodies/block/Lower corner=-7, 0",
            "Bodies/block/Upper corner=-5, 1",
            "Bodies/lower/Shape=box",
            "Bodies/lower/Lower corner=4, 0",
            "Bodies/lower/Upper corner=6, 1",
            "Bodies/lower/Material=stiff",
            "Output/Field interval=10",
            "End time=1.9"});
    const Table  table = runout_of("runout-outflow");
    const double acceleration =
      9.81 * (std::sin(M_PI / 6.) - 0.3 * std::cos(M_PI / 6.));
    const double way = 0.5 * acceleration * 1.9 * 1.9, centre_at_start = -0.5;
    Verification gates("Block that slides on while another one has left",
                       "prm/" + file,
                       "a t^2 / 2");
    gates.at_most("rear - that of a rigid block [cells]",
                  std::abs(table["rear along path [m]"].back() -
                           (-7. + way - centre_at_start)) /
                    0.25,
                  1.);
    gates.at_most("front - that of a rigid block [cells]",
                  std::abs(table["front along path [m]"].back() -
                           (-5. + way - centre_at_start)) /
                    0.25,
                  1.);
  }



  // Along a path of the user that has a bend.
  TEST(Runout, FollowsAPathOfTheUser)
  {
    run<3>("block-downhill-3d.prm",
           "runout-path",
           {"Runout/Path=0, 0; -2, 0; -2, -1", "End time=0.2"});
    const Table table = runout_of("runout-path");
    // The columns of the block reach from x = 1 m to -1 m, in front of the
    // bend.
    EXPECT_DOUBLE_EQ(table["rear along path [m]"].front(), -1.);
    EXPECT_DOUBLE_EQ(table["front along path [m]"].front(), 1.);
    EXPECT_EQ(table["runout [m]"].front(), 0.);
    EXPECT_DOUBLE_EQ(table["area in plan [m^2]"].front(), 4.);
  }
} // namespace runout_test
