// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/splitter.h>
#include <talus/observers/point_motion.h>
#include <talus/observers/profile.h>
#include <talus/observers/statistics.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <map>

#include "observers_setup.h"
#include "obstacles_setup.h"

namespace
{
  using namespace talus;

  template <int dim>
  Ground<dim>
  on_bottom(const Scene<dim> &s)
  {
    return Ground<dim>(s.grid.domain());
  }



  // ------------------------------------------------------------- statistics

  class StatisticsTest : public ObserversTest
  {
  protected:
    template <int dim>
    static std::map<std::string, double>
    evaluate(const Statistics<dim> &statistics, const State<dim> &state)
    {
      std::map<std::string, double> values;
      for (const auto &quantity : statistics.evaluate(state))
        values[quantity.heading()] = quantity.value;
      return values;
    }

    /// Somebody else's quantity.
    template <int dim>
    static void
    count_nodes(const State<dim> &state, Quantities &list)
    {
      list.push_back({"nodes", "", 1. * state.grid.n_nodes()});
    }
  };



  TEST_F(StatisticsTest, Header)
  {
    const auto along = [](const std::string &axis) {
      return "front " + axis + " [m],front of 99.5 % mass " + axis +
             " [m],rear " + axis + " [m],";
    };
    const std::string first = "time [s],step,time step [s],points,";
    const std::string speed = "maximum speed [m/s],maximum speed of points "
                              "[m/s],mass [kg],";
    const std::string last =
      "kinetic energy [J],"
      "grid kinetic energy [J],elastic energy [J],plastic work [J],"
      "friction work [J],contact work [J],damping work [J],"
      "gravity work [J],energy remainder [J],empty interior cells,empty "
      "columns,"
      "connected bodies,cells with one point,"
      "nodes";
    {
      Scene<2> s("0, 0", "8, 4");
      s.add({0.5, 0.5});
      Statistics<2> statistics;
      statistics.add_source(count_nodes<2>);
      statistics.begin({folder}, s);
      EXPECT_EQ(lines("statistics.csv").at(0),
                first + along("x") +
                  "height [m],centre x [m],centre y [m],centre velocity x "
                  "[m/s],centre velocity y [m/s]," +
                  speed +
                  "momentum x [kg m/s],momentum y [kg m/s],seabed force x [N],"
                  "seabed force y [N],seabed impulse x [N s],"
                  "seabed impulse y [N s]," +
                  last);
    }
    dealii::ParameterAcceptor::clear();
    Scene<3> s("0, 0, 0", "8, 4, 4");
    s.add({0.5, 0.5, 0.5});
    Statistics<3> statistics;
    statistics.add_source(count_nodes<3>);
    statistics.begin({folder}, s);
    EXPECT_EQ(lines("statistics.csv").at(0),
              first + along("x") + along("z") +
                "height [m],centre x [m],centre y [m],centre z [m],"
                "centre velocity x [m/s],centre velocity y [m/s],"
                "centre velocity z [m/s]," +
                speed +
                "momentum x [kg m/s],momentum y [kg m/s],momentum z [kg m/s],"
                "seabed force x [N],seabed force y [N],seabed force z [N],"
                "seabed impulse x [N s],seabed impulse y [N s],"
                "seabed impulse z [N s]," +
                last);
  }



  TEST_F(StatisticsTest, QuantitiesOfTwoPoints)
  {
    Scene<2> s("0, -1", "8, 3");
    s.add({1., 0.5}, 3., {2., 0.});
    s.add({5., 1.5}, 1., {-3., 4.});
    const Splitter<2> splitter;
    Statistics<2>     statistics;
    statistics.add_source([&](const State<2> &state, Quantities &list) {
      splitter.list_quantities(state, list);
    });
    s.stretch(1, 1, 3.);
    s.sort();
    statistics.begin({folder}, s);
    statistics.start(s);
    statistics.observe(s);

    s.time                               = 0.5;
    s.step                               = 7;
    s.time_step                          = 0.125;
    s.accounts.impulse("seabed impulse") = dealii::Tensor<1, 2>({-6., 9.});
    auto row                             = evaluate(statistics, s);
    EXPECT_EQ(row["time [s]"], 0.5);
    EXPECT_EQ(row["step"], 7);
    EXPECT_EQ(row["time step [s]"], 0.125);
    EXPECT_EQ(row["points"], 2);
    EXPECT_EQ(row["front x [m]"], 5.);
    EXPECT_EQ(row["front of 99.5 % mass x [m]"], 5.);
    EXPECT_EQ(row["rear x [m]"], 1.);
    EXPECT_EQ(row["height [m]"], 2.5);
    EXPECT_EQ(row["centre x [m]"], 2.);
    EXPECT_EQ(row["centre y [m]"], 0.75);
    EXPECT_EQ(row["centre velocity x [m/s]"], 0.75);
    EXPECT_EQ(row["centre velocity y [m/s]"], 1.);
    EXPECT_EQ(row["maximum speed [m/s]"], 0.);
    EXPECT_EQ(row["maximum speed of points [m/s]"], 5.);
    EXPECT_EQ(row["mass [kg]"], 4.);
    EXPECT_EQ(row["momentum x [kg m/s]"], 3.);
    EXPECT_EQ(row["momentum y [kg m/s]"], 4.);
    EXPECT_EQ(row["seabed force x [N]"], -12.);
    EXPECT_EQ(row["seabed force y [N]"], 18.);
    EXPECT_EQ(row["seabed impulse x [N s]"], -6.);
    EXPECT_EQ(row["kinetic energy [J]"], 6. + 12.5);
    EXPECT_EQ(row["splits"], 0);
    EXPECT_EQ(row["largest generation"], 0);
    // 0.1 to 0.5 cells are allowed to either side of the centre.
    EXPECT_EQ(row["clipped boxes"], 1);
    EXPECT_EQ(row["split conservation error [-]"], 0);

    // The force is the mean since the row before; the impulse goes on.
    statistics.observe(s);
    s.time                                  = 1.;
    s.accounts.impulse("seabed impulse")[0] = -7.;
    row                                     = evaluate(statistics, s);
    EXPECT_EQ(row["seabed force x [N]"], -2.);
    EXPECT_EQ(row["seabed force y [N]"], 0.);
    EXPECT_EQ(row["seabed impulse x [N s]"], -7.);
    EXPECT_EQ(lines("statistics.csv").size(), 3u);
  }



  TEST_F(StatisticsTest, EnergyBudget)
  {
    Scene<2> s("0, 0", "8, 4");
    s.add({1.5, 0.5}, 2., {3., 0.}); // 9 J
    s.points.data(s.points.elastic_energy)[0] = 5.;
    Statistics<2> statistics;
    statistics.begin({folder}, s);
    statistics.start(s);
    statistics.observe(s);
    EXPECT_EQ(evaluate(statistics, s)["energy remainder [J]"], 0.);

    s.points.data(s.points.velocity, 1)[0]    = 4.; // 25 J
    s.points.data(s.points.elastic_energy)[0] = 6.;
    s.points.data(s.points.plastic_work)[0]   = 10.;
    s.accounts.energy("friction work")        = 20.;
    s.accounts.energy("contact work")         = 0.5;
    s.accounts.energy("damping work")         = 4.;
    s.accounts.energy("gravity work")         = 50.;
    // A node with 2 kg at 3 m/s: (momentum + dt force) / mass.
    s.nodes.activate(s.grid, {0});
    s.nodes.clear();
    s.nodes.set_sums(s.nodes.active_nodes()[0],
                     2.,
                     0.,
                     dealii::Point<2>(0., 5.),
                     dealii::Point<2>(0., 10.));
    s.nodes.update_momentum(0.1, 1e-9);

    auto row = evaluate(statistics, s);
    EXPECT_EQ(row["kinetic energy [J]"], 25.);
    EXPECT_EQ(row["grid kinetic energy [J]"], 9.);
    EXPECT_EQ(row["maximum speed [m/s]"], 3.);
    EXPECT_EQ(row["elastic energy [J]"], 6.);
    EXPECT_EQ(row["plastic work [J]"], 10.);
    EXPECT_EQ(row["friction work [J]"], 20.);
    EXPECT_EQ(row["contact work [J]"], 0.5);
    EXPECT_EQ(row["damping work [J]"], 4.);
    EXPECT_EQ(row["gravity work [J]"], 50.);
    EXPECT_EQ(row["energy remainder [J]"],
              50. - 16. - 1. - 10. - 20. - 0.5 - 4.);
  }



  TEST_F(StatisticsTest, FrontOfMass)
  {
    Scene<2> s("0, 0", "8, 4");
    for (unsigned int p = 0; p < 200; ++p)
      s.add({(p * 77 % 200) * 0.01, 0.5}, 0.1);
    // 199 of 200 equal points are 99.5 %, whatever the order.
    EXPECT_EQ(front_of_mass(s.points, 0, 0.995, MPI_COMM_WORLD), 1.98);
    EXPECT_EQ(front_of_mass(s.points, 0, 0.9951, MPI_COMM_WORLD), 1.99);
    EXPECT_EQ(front_of_mass(s.points, 0, 0.5, MPI_COMM_WORLD), 0.99);
    EXPECT_EQ(front_of_mass(s.points, 0, 1., MPI_COMM_WORLD), 1.99);
    // A light point far ahead does not count.
    s.add({7.9, 0.5}, 0.01);
    EXPECT_EQ(front_of_mass(s.points, 0, 0.995, MPI_COMM_WORLD), 1.99);
  }



  TEST_F(StatisticsTest, NumbersKeepSixteenDigits)
  {
    Scene<2> s("0, 0", "8, 4");
    s.add({1. / 3., 0.5});
    Statistics<2> statistics;
    statistics.begin({folder}, s);
    statistics.start(s);
    statistics.observe(s);
    EXPECT_NE(lines("statistics.csv").at(1).find("0.3333333333333333,"),
              std::string::npos);
  }



  // The point that is farthest from the bed is not the highest one.
  TEST_F(StatisticsTest, HeightAboveAnInclinedBed)
  {
    Scene<2>               s("0, 0", "8, 4");
    const WithObstacles<2> bed{
      {"bed", "Shape = half-plane|Point = 0, 2|Normal = 0.25, 1"}};
    s.add({1., 3.});  // 1.25 m above it
    s.add({6., 2.5}); // 2 m
    EXPECT_NEAR(evaluate(Statistics<2>(&bed.obstacles), s)["height [m]"],
                2.,
                1e-12);
    EXPECT_EQ(evaluate(Statistics<2>(), s)["height [m]"], 3.);
  }



  // ---------------------------------------------------------------- profile

  class ProfileTest : public ObserversTest
  {};



  TEST_F(ProfileTest, Columns)
  {
    Scene<2> s("0, 0", "8, 4");
    // Boxes of 0.5 x 0.5 m; the second one has a quarter in the next column.
    s.add({2.25, 0.5}, 1., {1., 9.});
    s.add({2.875, 1.5}, 4., {3., 9.});
    s.add({4.5, 0.25}, 1., {-1., 9.});
    Profile<2> profile;
    profile.begin({folder}, s);
    s.time = 0.5;
    profile.observe(s);
    const auto file = lines("profile.csv");
    ASSERT_EQ(file.size(), 4u);
    EXPECT_EQ(file[0],
              "time [s],x [m],lowest [m],highest [m],thickness [m],"
              "depth-mean velocity [m/s]");
    EXPECT_EQ(file[1], "0.5,2.5,0.25,1.75,0.4375,2.5");
    EXPECT_EQ(file[2], "0.5,3.5,1.25,1.75,0.0625,3");
    EXPECT_EQ(file[3], "0.5,4.5,0,0.5,0.25,-1");

    // After a quarter of a turn what was along x, 0.5 m, is along y.
    s.constants.box_shape.rule = BoxRule::convected_domain;
    const Matrix<2, double> turned{{{{{0., -0.25}}, {{0.5, 0.}}}}};
    store_matrix(s.points, s.points.edges, 2, turned);
    update_box_lengths(s.points, 0, 3, s.constants.box_shape.rule);
    EXPECT_EQ(find_profile(s, on_bottom(s)).at(2).highest, 0.5);
  }



  // At the middle of the column, also where a box dips into the bed.
  TEST_F(ProfileTest, GroundBelowTheColumns)
  {
    Scene<2>               s("0, 0", "8, 4");
    const WithObstacles<2> bed{
      {"bed", "Shape = half-plane|Point = 0, 2|Normal = 0.25, 1"},
      {"pipe", "Shape = ball|Centre = 4.5, 1.4|Radius = 0.4"}};
    s.add({2.5, 1.5});
    s.add({4.5, 2.5});
    Profile<2> profile(&bed.obstacles);
    profile.begin({folder}, s);
    profile.observe(s);
    EXPECT_EQ(lines("profile.csv").at(0),
              "time [s],x [m],lowest [m],highest [m],thickness [m],"
              "depth-mean velocity [m/s],ground [m]");
    const auto columns =
      find_profile(s, Ground<2>(s.grid.domain(), &bed.obstacles));
    ASSERT_EQ(columns.size(), 2u);
    EXPECT_EQ(columns[0].lowest, 1.25);
    EXPECT_NEAR(columns[0].ground, 2. - 0.25 * 2.5, 1e-12);
    EXPECT_NEAR(columns[1].ground, 2. - 0.25 * 4.5, 1e-12);
  }



  TEST_F(ProfileTest, ColumnsInThreeDimensions)
  {
    Scene<3> s("0, 0, 0", "8, 4, 4");
    s.add({2.5, 0.5, 3.5}, 1., {1., 9., 5.});
    s.add({2.5, 0.5, 1.5}, 1., {2., 9., 6.});
    Profile<3> profile;
    profile.begin({folder}, s);
    profile.observe(s);
    const auto file = lines("profile.csv");
    ASSERT_EQ(file.size(), 3u);
    EXPECT_EQ(file[0],
              "time [s],x [m],z [m],lowest [m],highest [m],thickness [m],"
              "depth-mean velocity [m/s],depth-mean velocity z [m/s]");
    EXPECT_EQ(file[1], "0,2.5,1.5,0.25,0.75,0.125,2,6");
    EXPECT_EQ(file[2], "0,2.5,3.5,0.25,0.75,0.125,1,5");
  }



  // A box over an edge of the lattice, one at a corner of the mesh, and one
  // outside of it: nothing is lost and nothing counted twice.
  TEST_F(ProfileTest, ColumnsShareABox)
  {
    Scene<3> s("0, 0, 0", "8, 4, 4");
    s.add({2., 0.5, 3.});
    s.add({0., 0.5, 3.875});
    s.add({9., 0.5, 1.5});
    const auto profile = find_profile(s, on_bottom(s));
    ASSERT_EQ(profile.size(), 6u);
    const std::vector<double> mass = {1., 0.25, 0.25, 0.25, 0.25, 1.};
    for (unsigned int i = 0; i < 6; ++i)
      {
        EXPECT_EQ(profile[i].mass, mass[i]);
        EXPECT_EQ(profile[i].thickness, 0.125 * mass[i]);
      }
    EXPECT_EQ(profile[1].x, 1.5);
    EXPECT_EQ(profile[1].z, 2.5);
    EXPECT_EQ(profile[5].x, 7.5);
  }
} // namespace
