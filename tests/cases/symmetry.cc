// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact does not depend on the directions of the axes, nor on the way in
// which a file says that an obstacle is at rest: slide-over-ridge.prm,
// box-in-slide-3d.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace symmetry_test
{
  template <int dim>
  Table
  obstacles_of(const std::string &file, const Overrides &overrides = {})
  {
    const std::string folder = "symmetry";
    run<dim>(file, folder, overrides);
    return Table(std::filesystem::path(TALUS_RESULTS_DIR) / folder /
                 "obstacles.csv");
  }



  /// Maximum difference between the column @p of_a of table @p a and the column
  /// @p of_b of table @p b times @p sign, over the largest value.
  double
  difference(const Table       &a,
             const std::string &of_a,
             const Table       &b,
             const std::string &of_b,
             const double       sign = 1.)
  {
    const auto &x = a[of_a], &y = b[of_b];
    double      error = (x.size() == y.size() ? 0. : 1e300), largest = 0;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
      {
        error   = std::max(error, std::abs(x[i] - sign * y[i]));
        largest = std::max(largest, std::abs(x[i]));
      }
    return error / largest;
  }



  // About 800 steps, 400 of them in contact, with splits. Rows of points are
  // merged from the lower end, so a slide with merging has no exact mirror
  // image: a row of its own.
  TEST(Symmetry, MirroredSlide)
  {
    Verification    gates("Slide over a ridge and its mirror image",
                       "tests/cases/slide-over-ridge.prm",
                       "symmetry");
    const Overrides mirrored = {
      "Gravity/Slope angle=-8",
      "Bodies/slide/Vertices=0,0; -14,0; -11,3.1; -3,3.1",
      "Obstacles/ridge/Vertices=-19.3,-1; -27.7,-1; -24.1,1.3; -23.2,1.37"};
    const auto pair = [&](const Overrides &settings) {
      return std::make_pair(obstacles_of<2>("slide-over-ridge.prm", settings),
                            obstacles_of<2>("slide-over-ridge.prm",
                                            settings + mirrored));
    };
    const auto [right, left] = pair({"Splitting/Merge=false"});
    for (const auto &[column, sign] :
         {std::make_pair("ridge force x [N]", -1.),
          std::make_pair("ridge force y [N]", 1.),
          std::make_pair("ridge contact area [m]", 1.)})
      gates.at_most("difference of the " + std::string(column) +
                      ", over the largest",
                    difference(right, column, left, column, sign),
                    1e-9);
    const auto [merged, merged_left] = pair({});
    gates.falls_short("difference of the ridge force x [N], over the largest, "
                      "with merging",
                      difference(merged,
                                 "ridge force x [N]",
                                 merged_left,
                                 "ridge force x [N]",
                                 -1.),
                      1e-9,
                      {0.5,
                       "rows of points are merged from the lower end; merged "
                       "from the end nearest to a face of the cell, "
                       "slab-failure.prm tears"});
  }



  TEST(Symmetry, BoxWithExchangedAxes)
  {
    Verification gates("Box in a slide, axes x and z exchanged",
                       "tests/cases/box-in-slide-3d.prm",
                       "symmetry");
    const Table  along_x = obstacles_of<3>("box-in-slide-3d.prm"),
                along_z =
                  obstacles_of<3>("box-in-slide-3d.prm",
                                  {"Grid/Upper corner=8,5,12",
                                   "Bodies/slide/Lower corner=2,0,1.3",
                                   "Bodies/slide/Upper corner=6.4,2.6,5.2",
                                   "Bodies/slide/Initial velocity=0.7; 0; 3",
                                   "Obstacles/box/Lower corner=2.2,0,6.2",
                                   "Obstacles/box/Upper corner=4.7,2.4,8.4"});
    const auto at_most = [&](const std::string &x, const std::string &z) {
      gates.at_most("difference of the " + x + ", over the largest",
                    difference(along_x, x, along_z, z),
                    1e-9);
    };
    at_most("box impulse x [N s]", "box impulse z [N s]");
    at_most("box friction work [J]", "box friction work [J]");
    at_most("box contact area [m^2]", "box contact area [m^2]");
  }



  TEST(Symmetry, ThreeWaysToBeAtRest)
  {
    Verification gates("Box in a slide, velocity zero or 1e15 kg",
                       "tests/cases/box-in-slide-3d.prm",
                       "the box without velocity and mass");
    const Table  at_rest = obstacles_of<3>("box-in-slide-3d.prm");
    for (const std::string set : {"Velocity=0; 0; 0", "Mass=1e15"})
      {
        const Table moving =
          obstacles_of<3>("box-in-slide-3d.prm", {"Obstacles/box/" + set});
        for (const std::string column : {"box impulse x [N s]",
                                         "box friction work [J]",
                                         "box contact area [m^2]"})
          gates.falls_short(set + ": difference of the " + column +
                              ", over the largest",
                            difference(at_rest, column, moving, column),
                            1e-9,
                            {0.5,
                             "one sweep over the facets in a step at rest, "
                             "four in motion; four at rest change the friction "
                             "on an arc by 0.7 %"});
      }
  }
} // namespace symmetry_test
