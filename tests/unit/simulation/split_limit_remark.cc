// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/split_limit_remark.h>

#include "core_setup.h"

// Two points at the largest generation, stretched beyond the threshold, and one
// whose children would leave the mesh; points that may be split are no reason.
TEST(SplitLimitRemark, PointsThatCannotBeSplitAreToldOnce)
{
  using namespace talus;
  using dealii::Point;
  Core<2> core(cube<2>() +
               in_section("Splitting",
                          "set Shear = counted\nset Directions = all\n"
                          "set Minimum length = 0\nset Threshold = 1.5\n"
                          "set Maximum generation = 2"));
  core.constants.box_shape = core.transfer.box_shape();
  const auto add           = [&](const double x, const double generation) {
    const unsigned int p = core.add(Point<2>(x, 1.5), Point<2>(0.6, 0.6));
    core.stretch(p, 0, 1.6);
    core.points.data(core.points.generation)[p] = generation;
  };
  add(1.5, 1.);
  core.sort();
  Log                 log{MPI_COMM_WORLD};
  SplitLimitRemark<2> remark(core.splitter, log);
  remark.observe(core);
  EXPECT_EQ(log.count_of_remarks(), "");
  add(2.5, 2.);
  add(3.5, 2.);
  add(-0.45, 0.);
  core.sort();
  testing::internal::CaptureStdout();
  remark.observe(core);
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(contains(said, "2 points reached 'Splitting/Maximum")) << said;
  EXPECT_TRUE(contains(said, "1 point would get children more than half"))
    << said;
  remark.observe(core);
  EXPECT_EQ(log.count_of_remarks(), "1 remark");
}
