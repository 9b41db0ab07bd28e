// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/footprint.h>
#include <talus/simulation/run_remarks.h>

#include "../contact/soil_on_bed.h"
#include "../whole_problem.h"

namespace run_remarks_test
{
  /// Soil from x = 0 to 3 m after a step of contact with a bed, @p height m
  /// below the soil.
  struct Areas : SoilOnBed<2>
  {
    explicit Areas(const double height)
    {
      time_step = 0.1;
      fill_boxes({0., 2. + height}, {3., 3.5 + height});
      move(Point<2>(0., -1.));
      contact.find_soil(*this);
      contact.correct_velocities(*this);
      remarks.add("contact area remark", [this](const State<2> &state) {
        return remark_on_contact_area(state.time, row);
      });
    }

    /// Write a row, and return the number of remarks.
    std::string
    observe()
    {
      row.clear();
      list_contact_area(*this, boundaries, contact, row);
      remarks.observe(*this);
      return log.count_of_remarks();
    }

    Log           log{MPI_COMM_WORLD};
    RunRemarks<2> remarks{log};
    Quantities    row; ///< contact area and footprint, m
  };
} // namespace run_remarks_test



// Facets whose nodes have soil: 3 m under the soil, and a little of the facet
// beside. For soil 0.3 m above the bed there is no contact, and no remark,
// since soil may start in the air.
TEST(RunRemarks, AreasOfSoilOnAndAboveTheBed)
{
  using namespace run_remarks_test;
  for (const double height : {0., 0.3})
    {
      Areas soil(height);
      EXPECT_EQ(soil.observe(), "");
      ASSERT_EQ(soil.row.size(), 2u);
      EXPECT_NEAR(soil.row[0].value, height == 0. ? 3. : 0., 0.01);
      EXPECT_NEAR(soil.row[1].value, 3., 1e-12);
    }
}



// The upper boxes are moved over further 3 m of ground, without contact there.
TEST(RunRemarks, SoilInTheAirIsRemarkedOnce)
{
  using namespace run_remarks_test;
  Areas soil(0.);
  EXPECT_EQ(soil.observe(), "");
  for (unsigned int p = 0; p < soil.points.size(); ++p)
    if (soil.get(soil.points.position, p)[1] > 3.)
      soil.points.data(soil.points.position)[p] += 3.;
  soil.sort();
  EXPECT_EQ(soil.observe(), "1 remark");
  EXPECT_NEAR(soil.row[1].value, 6., 1e-12);
  EXPECT_EQ(soil.observe(), "1 remark");
}



// Two points at the largest generation, stretched beyond the threshold, and one
// whose children would leave the mesh; points that may be split are no reason.
TEST(RunRemarks, PointsThatCannotBeSplitAreToldOnce)
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
  Log           log{MPI_COMM_WORLD};
  RunRemarks<2> remarks(log);
  remarks.add("split limit remark", [&](const State<2> &state) {
    return remark_on_split_limits(state, core.splitter);
  });
  remarks.observe(core);
  EXPECT_EQ(log.count_of_remarks(), "");
  add(2.5, 2.);
  add(3.5, 2.);
  add(-0.45, 0.);
  core.sort();
  testing::internal::CaptureStdout();
  remarks.observe(core);
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(contains(said, "2 points reached 'Splitting/Maximum")) << said;
  EXPECT_TRUE(contains(said, "1 point would get children more than half"))
    << said;
  remarks.observe(core);
  EXPECT_EQ(log.count_of_remarks(), "1 remark");
}



// The block falls at the share m of the speed of its waves.
TEST(RunRemarks, SoilNearItsWaveSpeedIsToldOnce)
{
  using namespace talus;
  WholeProblem<Transfer<2>> soil;
  Log                       log{MPI_COMM_WORLD};
  RunRemarks<2>             remarks(log);
  remarks.add("speed remark", [&soil](const State<2> &state) {
    return remark_on_speed(state, soil.problem.materials);
  });
  soil.observed.use_bbar({false});
  const double c = soil.problem.materials.of_body(0).wave_speed(soil.points, 0);
  for (const double m : {0.44, 0.5, 0.6})
    {
      Loads<2> none;
      none.acceleration_of_body.resize(1);
      std::fill_n(soil.points.data(soil.points.velocity, 1),
                  soil.points.size(),
                  -m * c);
      soil.nodes.prepare(soil.grid);
      soil.nodes.activate(soil.grid, soil.relocation.occupied_cells());
      soil.workspace.reinit(0, soil.points.size());
      soil.observed.scatter(soil.with(none), soil.points.all());
      soil.nodes.update_momentum(0., 0.);
      testing::internal::CaptureStdout();
      remarks.observe(soil);
      EXPECT_EQ(contains(testing::internal::GetCapturedStdout(),
                         "(v/c)^2 is 0.25, where at most 0.2"),
                m == 0.5);
    }
}
