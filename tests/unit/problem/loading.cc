// SPDX-License-Identifier: LGPL-2.1-or-later
// Gravity, the motion of the ground, and forces by expression.

#include <talus/problem/loading.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Tensor;
  using std::cos;
  using std::sin;

  constexpr double g     = 9.81;                               // m/s^2
  constexpr double angle = dealii::numbers::PI / 6;            // of the slope
  const double     down = g * 0.5, away = g * std::sqrt(0.75); // of gravity



  /// Two materials, dry and submerged, on a slope of 30 degrees.
  template <int dim>
  struct Loaded : FreshParameters
  {
    explicit Loaded(const std::string &entries, const std::string &table = "")
      : folder(std::filesystem::temp_directory_path() /
               ("talus-loading-" + std::to_string(getpid())))
      , materials({{"dry", "linear elastic"}, {"wet", "linear elastic"}})
      , loading(folder)
    {
      std::filesystem::create_directories(folder);
      std::ofstream(folder / "ground.csv") << table;
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        in_section("Materials",
                   in_section("dry", "set Density = 1600") +
                     in_section("wet",
                                "set Density = 1600\n"
                                "set Submerged density = 600")) +
        in_section("Gravity", "set Slope angle = 30") + entries);
      ParameterAcceptor::parse_all_parameters();
      materials.assign({"dry", "wet"}, {"dry", "wet"});
    }

    ~Loaded()
    {
      std::filesystem::remove_all(folder);
    }

    void
    prepare()
    {
      loading.prepare(materials, 2, Constants(), 100.);
    }

    /// Of body @p b at time @p t.
    Tensor<1, dim>
    acceleration(const double t, const unsigned int b = 0)
    {
      loading.update(points, t);
      return loading.loads().acceleration_of_body[b];
    }

    std::filesystem::path folder;
    Materials<dim>        materials;
    Loading<dim>          loading;
    Points<dim>           points;
  };



  template <int dim>
  void
  expect_near(const Tensor<1, dim> &a, const std::vector<double> &expected)
  {
    for (unsigned int d = 0; d < dim; ++d)
      EXPECT_NEAR(a[d], expected[d], 1e-14 * g) << d;
  }



  const std::string shaken =
    in_section("Ground motion",
               "set File = ground.csv\nset Start time = 10\nset Factor = 2");



  TEST(Loading, GravityOnASlope)
  {
    Loaded<3> all("");
    all.prepare();
    expect_near<3>(all.acceleration(0.), {down, -away, 0.});
    // The weight of the submerged mass, the inertia of the whole.
    const double share = 600. / 1600.;
    expect_near<3>(all.acceleration(0., 1), {share * down, -share * away, 0.});
    EXPECT_FALSE(all.loading.loads().varies);
  }



  // Without gravity, any other load shows the user's intention.
  TEST(Loading, SoilWithoutWeightIsRemarked)
  {
    const auto note = [](const std::string &entries) {
      Loaded<2> all(entries, "time [s],horizontal [m/s^2]\n0,0\n1,1\n");
      all.prepare();
      return all.loading.note();
    };
    const std::string none = in_section("Gravity", "set Magnitude = 0");
    EXPECT_TRUE(contains(note(none), "'Gravity/Magnitude' is 0")) << note(none);
    EXPECT_EQ(note(""), "");
    EXPECT_EQ(note(none + in_section("Body force", "set Expression = 1; 0")),
              "");
    EXPECT_EQ(note(none + in_section("Ground motion", "set File = ground.csv")),
              "");
  }



  TEST(Loading, RampIsHalfACosine)
  {
    Loaded<2> all(in_section("Gravity", "set Ramp time = 8"));
    all.prepare();
    EXPECT_EQ(all.loading.share_of_gravity(0.), 0.);
    EXPECT_NEAR(all.loading.share_of_gravity(2.),
                0.5 * (1. - std::sqrt(0.5)),
                1e-15);
    EXPECT_NEAR(all.loading.share_of_gravity(4.), 0.5, 1e-15);
    EXPECT_NEAR(all.loading.share_of_gravity(6.),
                0.5 * (1. + std::sqrt(0.5)),
                1e-15);
    EXPECT_EQ(all.loading.share_of_gravity(8.), 1.);
    EXPECT_EQ(all.loading.share_of_gravity(100.), 1.);
    expect_near<2>(all.acceleration(4.), {0.5 * down, -0.5 * away});
  }



  // In the frame of the ground, soil of any density feels minus the
  // acceleration of the ground. In a turned mesh the horizontal part points up
  // and down, too.
  TEST(Loading, GroundMotionInTheFrameOfTheSlope)
  {
    Loaded<2> all(shaken,
                  "time [s],horizontal [m/s^2],vertical [m/s^2]\n"
                  "0,0,0\n1,3,0\n2,3,4\n");
    all.prepare();
    const auto expect =
      [&](const double t, const double a_h, const double a_v) {
        const double a_x = a_h * cos(angle) - a_v * sin(angle);
        const double a_y = a_h * sin(angle) + a_v * cos(angle);
        expect_near<2>(all.acceleration(t), {down - a_x, -away - a_y});
        const double share = 600. / 1600.;
        expect_near<2>(all.acceleration(t, 1),
                       {share * down - a_x, -share * away - a_y});
      };
    expect(9., 0., 0.);
    expect(10., 0., 0.);
    expect(10.5, 3., 0.);
    expect(11., 6., 0.);
    expect(11.5, 6., 4.);
    expect(12., 6., 8.);
    expect(12.001, 0., 0.);
  }



  TEST(Loading, GroundMotionAcrossAndGravityFactor)
  {
    Loaded<3> all(shaken,
                  "time [s],across [m/s^2],gravity factor [-]\n"
                  "0,0,1\n1,5,3\n");
    all.prepare();
    expect_near<3>(all.acceleration(0.), {down, -away, 0.});
    expect_near<3>(all.acceleration(10.5), {2. * down, -2. * away, -5.});
    expect_near<3>(all.acceleration(11.), {3. * down, -3. * away, -10.});
    // Gravity stays after the last row.
    expect_near<3>(all.acceleration(99.), {3. * down, -3. * away, 0.});
    EXPECT_EQ(all.loading.time_of_last_change(), 11.);
  }



  TEST(Loading, GroundMotionThatCannotBeIsRefused)
  {
    const auto error = [](const std::string &entries,
                          const std::string &table) {
      Loaded<2> all(entries, table);
      return message_of<ExcUser>([&] { all.prepare(); });
    };
    const auto expect = [](const std::string &said, const std::string &part) {
      EXPECT_TRUE(contains(said, part)) << said;
    };
    expect(error(shaken, "time [s],horizontal [m/s^2]\n0,1\n1,0\n"),
           "begins at t = 10 s of the run with 2 m/s^2 in the column "
           "'horizontal [m/s^2]': the ground would jump into motion");
    expect(error(shaken, "time [s],across [m/s^2]\n0,0\n1,1\n"),
           "but the simulation is two-dimensional");
    expect(error(in_section("Ground motion", "set Factor = 2"), ""),
           "'Ground motion/File' is empty");
    expect(error(in_section("Ground motion",
                            "set File = ground.csv\nset Factor = 0"),
                 "time [s],horizontal [m/s^2]\n0,0\n1,1\n"),
           "'Ground motion/Factor' is 0");
    // The run is from 0 to 100 s.
    for (const std::string start : {"100", "-1"})
      expect(error(in_section("Ground motion",
                              "set File = ground.csv\nset Start time = " +
                                start),
                   "time [s],horizontal [m/s^2]\n0,0\n1,0\n"),
             "it would never act");
    // With the run it may begin with any acceleration.
    EXPECT_EQ(error(in_section("Ground motion", "set File = ground.csv"),
                    "time [s],horizontal [m/s^2]\n0,1\n1,0\n"),
              "");
  }



  TEST(Loading, BodyForceByExpression)
  {
    for (const std::string where : {"spatial", "material"})
      {
        Loaded<2> all(in_section("Body force",
                                 "set Expression = x*t; 2*y+1\n"
                                 "set Coordinates = " +
                                   where));
        auto     &points = all.points;
        points.append(1);
        points.data(points.position, 0)[0]         = 3.;
        points.data(points.position, 1)[0]         = 4.;
        points.data(points.initial_position, 0)[0] = 5.;
        points.data(points.initial_position, 1)[0] = 6.;
        all.prepare();
        expect_near<2>(all.acceleration(7.), {down, -away});
        ASSERT_TRUE(all.loading.loads().varies);
        const auto &rows       = all.loading.loads().acceleration_of_point;
        const bool  is_spatial = where == "spatial";
        EXPECT_DOUBLE_EQ(rows[0][0], (is_spatial ? 3. : 5.) * 7.);
        EXPECT_DOUBLE_EQ(rows[1][0], 2. * (is_spatial ? 4. : 6.) + 1.);
      }
  }
} // namespace
