// SPDX-License-Identifier: LGPL-2.1-or-later
// Strength that falls in time, at the points of a region.

#include <talus/problem/trigger.h>

#include "core_setup.h"

namespace trigger_test
{
  using namespace talus;
  using dealii::Point;

  /// Bodies "clay" (0) and "mud" (1) with strength, "rock" (2) without; each
  /// has a point at x = 0.5 m and a point at x = 1.5 m.
  struct Triggered : FreshParameters
  {
    explicit Triggered(const std::string &entries)
      : materials({{"clay", "von Mises"},
                   {"mud", "von Mises"},
                   {"rock", "linear elastic"}})
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        in_section("Trigger", entries));
      ParameterAcceptor::parse_all_parameters();
      materials.assign(names, names);
    }

    void
    check(const double end_time = 100., const bool has_limit = true)
    {
      trigger.check(names, materials, has_limit, end_time);
    }

    void
    add_points()
    {
      materials.add_columns(points, trigger.changes_strength());
      trigger.add_columns(points);
      for (unsigned int body = 0; body < 3; ++body)
        for (const double x : {0.5, 1.5})
          {
            const unsigned int p                    = points.append(1);
            points.data(points.body)[p]             = body;
            points.data(points.initial_position)[p] = x;
            // Displaced: the place at the start counts.
            points.data(points.position)[p] = 2. - x;
            factor(p)                       = 1.;
          }
      trigger.choose_points(points, Constants(), {}, MPI_COMM_SELF);
    }

    double &
    factor(const unsigned int p)
    {
      return points.data(materials.strength_factor())[p];
    }

    std::vector<double>
    factors_after_step(const double before, const double now)
    {
      trigger.update(points, materials.strength_factor(), before, now);
      std::vector<double> result;
      for (unsigned int p = 0; p < points.size(); ++p)
        result.push_back(factor(p));
      return result;
    }

    const std::vector<std::string> names{"clay", "mud", "rock"};
    Materials<2>                   materials;
    Trigger<2>                     trigger;
    Points<2>                      points;
  };



  const std::string within_two_seconds =
    "set Start time = 5\nset Duration = 2\n";
} // namespace trigger_test



TEST(TriggerInTime, SeabedByHalfACosine)
{
  using namespace trigger_test;
  Triggered soil(within_two_seconds + "set Seabed shear stress fraction = 0.2");
  soil.check();
  EXPECT_FALSE(soil.trigger.changes_strength());
  for (const auto &[t, progress] : {std::pair(0., 0.),
                                    {5., 0.},
                                    {5.5, 0.5 * (1. - std::sqrt(0.5))},
                                    {6., 0.5},
                                    {6.5, 0.5 * (1. + std::sqrt(0.5))},
                                    {7., 1.},
                                    {1e9, 1.}})
    EXPECT_NEAR(soil.trigger.seabed_factor(t), 1. - 0.8 * progress, 1e-15) << t;
  EXPECT_EQ(soil.trigger.end_time(), 7.);
  EXPECT_EQ(
    soil.trigger.note(),
    "From t = 5 s to 7 s the seabed's maximum shear stress falls to 0.2 "
    "of itself.");
}



TEST(TriggerInTime, AtOnceWithoutDuration)
{
  using namespace trigger_test;
  Triggered soil("set Start time = 5\nset Strength fraction = 0.4");
  soil.check();
  soil.add_points();
  const std::vector<double> all(6, 1.);
  EXPECT_EQ(soil.factors_after_step(4.9, 5.), all);
  const auto after = soil.factors_after_step(5., 5.1);
  for (const unsigned int p : {0, 1, 2, 3})
    EXPECT_DOUBLE_EQ(after[p], 0.4);
  // Without strength there is no loss.
  EXPECT_EQ(after[4], 1.);
  EXPECT_EQ(after[5], 1.);
}



TEST(TriggerInTime, BodiesAndRegionChooseThePoints)
{
  using namespace trigger_test;
  Triggered soil(within_two_seconds + "set Strength fraction = 0.5\n"
                                      "set Bodies = mud\n"
                                      "set Region = 1 - x");
  soil.check();
  soil.add_points();
  EXPECT_EQ(soil.factors_after_step(5.9, 6.),
            (std::vector<double>{1., 1., 0.75, 1., 1., 1.}));
  EXPECT_EQ(soil.factors_after_step(6.9, 7.1),
            (std::vector<double>{1., 1., 0.5, 1., 1., 1.}));
}



// The factor is a function of time: steps of any length lead to the same value,
// and a step in which nothing changes touches no point.
TEST(TriggerInTime, FactorsAreSetAndNotMultiplied)
{
  using namespace trigger_test;
  Triggered soil(within_two_seconds + "set Strength fraction = 0.5");
  soil.check();
  soil.add_points();
  for (double t = 5.; t < 6.; t += 0.125)
    soil.factors_after_step(t, t + 0.125);
  EXPECT_EQ(soil.factor(0), 0.75);
  soil.factor(0) = 0.123;
  soil.factors_after_step(3., 4.);
  soil.factors_after_step(7., 8.);
  EXPECT_EQ(soil.factor(0), 0.123);
  soil.factors_after_step(6.5, 7.5);
  EXPECT_EQ(soil.factor(0), 0.5);
}



TEST(TriggerInTime, ContradictionsAreRefused)
{
  using namespace trigger_test;
  const auto expect = [](const std::string &entries,
                         const std::string &part,
                         const bool         has_limit = true) {
    Triggered  soil(entries);
    const auto said =
      message_of<ExcUser>([&]() { soil.check(/*end_time=*/6., has_limit); });
    EXPECT_TRUE(part.empty() ? said.empty() : contains(said, part))
      << entries << ": " << said;
  };
  expect("", "");
  expect("set Start time = 1", "nothing would become weaker");
  expect("set Strength fraction = 0.5\nset Start time = 6",
         "'Trigger/Start time' is 6 s, but the run ends at 6 s");
  expect("set Seabed shear stress fraction = 0.5", "", true);
  expect("set Seabed shear stress fraction = 0.5",
         "no face of the mesh is a seabed, and no obstacle has a 'Maximum "
         "shear stress'",
         false);
  expect("set Seabed shear stress fraction = 0.5\nset Region = x",
         "'Trigger/Strength fraction' is 1: no soil becomes weaker");
  expect("set Strength fraction = 0.5\nset Seabed region = x",
         "'Trigger/Seabed region' is given, but 'Trigger/Seabed shear stress "
         "fraction' is 1");
  expect("set Seabed region = x", "nothing would become weaker");
  expect("set Strength fraction = 0.5\nset Bodies = sand",
         "lists 'sand', but Bodies/Names lists only: clay, mud, rock");
  expect("set Strength fraction = 0.5\nset Bodies = clay, rock",
         "lists 'rock', made of the material of section");
}



TEST(TriggerInTime, RegionWithoutPointsIsRefused)
{
  using namespace trigger_test;
  Triggered soil("set Strength fraction = 0.5\nset Region = x - 2");
  soil.check();
  EXPECT_TRUE(contains(
    message_of<ExcUser>([&]() { soil.add_points(); }),
    "'Trigger/Region' = 'x - 2' is positive at no point of the bodies"));
}



TEST(TriggerInTime, SeabedRegion)
{
  using namespace trigger_test;
  const std::string half = "set Seabed shear stress fraction = 0.5\n";
  {
    Triggered soil(half);
    EXPECT_FALSE(soil.trigger.seabed_region(Constants(), {}));
    soil.trigger.check_seabed_region(0);
  }
  Triggered soil(half + "set Seabed region = 20 - abs(x)");
  soil.check();
  const BedRegion<2> region = soil.trigger.seabed_region(Constants(), {});
  for (const double x : {-30., -20., -19., 0., 19., 21.})
    EXPECT_EQ(region(Point<2>(x, 7.)), std::abs(x) < 20.) << x;
  soil.trigger.check_seabed_region(1);
  EXPECT_TRUE(contains(message_of<ExcUser>(
                         [&]() { soil.trigger.check_seabed_region(0); }),
                       "is positive at no node of a seabed"));
  EXPECT_TRUE(contains(soil.trigger.note(), "in the region of the section"));
}
