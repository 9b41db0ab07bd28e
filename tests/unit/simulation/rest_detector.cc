// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether a slide has come to rest, for soil that is moved by hand.

#include <talus/simulation/rest_detector.h>

#include "ranks_setup.h"
#include "suites.h"

namespace rest_test
{
  TALUS_ALSO_ON_RANKS(RestDetector, 2);

  /// Soil that has slid by @p way, m, in cells of 1 m; looks every half second.
  struct Slide : Core<2>
  {
    explicit Slide(const double       way,
                   const bool         has_soil   = true,
                   const std::string &parameters = "")
      : Core<2>(slab<2>())
    {
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Rest", "set Duration = 5\n" + parameters));
      dealii::ParameterAcceptor::parse_all_parameters();
      // The first point is ahead of all others.
      unsigned int n = 0;
      if (has_soil)
        add_shared(*this, 20, 1, [&]() {
          return n++ == 0 ? Point<2>(4.6, 2.) : place(1.5);
        });
      for (unsigned int p = 0; p < points.size(); ++p)
        points.data(points.initial_position)[p] =
          points.data(points.position)[p] - way;
      sort();
    }

    /// Look at soil with the @p speed, m/s, at a time @p t, s.
    bool
    is_at_rest(const double t,
               const double speed,
               const double last_change = 0.)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        set(points.velocity, p, Point<2>(speed, 0.));
      scatter();
      nodes.update_momentum(0., 0.);
      time = t;
      rest.update(*this, last_change);
      return rest.is_at_rest();
    }

    /// First of the times 0.5, 1, ... 20 s at which soil with speed(t) is at
    /// rest after a peak at t = 0; infinity if never.
    template <typename Speed>
    double
    time_of_rest(const Speed &speed, const double last_change = 0.)
    {
      EXPECT_FALSE(is_at_rest(0., 1., last_change));
      for (double t = 0.5; t <= 20.; t += 0.5)
        if (is_at_rest(t, speed(t), last_change))
          return t;
      return std::numeric_limits<double>::infinity();
    }

    RestDetector<2> rest;
  };



  const double never = std::numeric_limits<double>::infinity();

  /// Kinetic energy of 1e-4 of the maximum, below the ratio of 1e-3.
  double
  slow(const double /*t*/)
  {
    return 0.01;
  }
} // namespace rest_test



TEST(RestDetector, FiveSecondsOfLittleEnergy)
{
  using namespace rest_test;
  {
    Slide slide(2.);
    EXPECT_EQ(slide.time_of_rest(slow), 5.5);
    EXPECT_EQ(
      slide.rest.sentence(5.5, 100.),
      "The soil is at rest since t = 0.5 s, so that the run ends at t = "
      "5.5 s, before 'End time' = 100 s ('End when at rest').");
    EXPECT_EQ(slide.rest.sentence(5.5, 5.5),
              "The soil is at rest since t = 0.5 s.");
  }
  {
    // Energy 1.6e-3 of the maximum until 3 s.
    Slide slide(2.);
    EXPECT_EQ(slide.time_of_rest(
                [](const double t) { return t <= 3. ? 0.04 : 0.01; }),
              8.5);
  }
  // A pulse at 4 s begins the five seconds anew.
  Slide slide(2.);
  EXPECT_EQ(slide.time_of_rest(
              [](const double t) { return t == 4. ? 0.5 : 0.01; }),
            9.5);
}



// Soil that moves with 1e-4 of the largest energy is at rest for a ratio of
// 2e-4, not for 5e-5.
TEST(RestDetector, RatioOfTheUser)
{
  using namespace rest_test;
  const auto time = [](const std::string &ratio) {
    return Slide(2., true, "set Kinetic energy ratio = " + ratio)
      .time_of_rest(slow);
  };
  EXPECT_EQ(time("2e-4"), 5.5);
  EXPECT_EQ(time("5e-5"), never);
}



TEST(RestDetector, LoadsMustHaveStoppedToChange)
{
  using namespace rest_test;
  EXPECT_EQ(Slide(2.).time_of_rest(slow, /*last_change=*/3.), 8.);
  EXPECT_EQ(Slide(2.).time_of_rest(slow, never), never);
}



// Creeping soil has little energy, but the ends move by more than a fiftieth of
// a cell.
TEST(RestDetector, OutermostPointsMustStay)
{
  using namespace rest_test;
  for (const double creep : {0.03, 0.001})
    {
      Slide slide(2.);
      EXPECT_EQ(slide.time_of_rest([&](const double /*t*/) {
        double *x = slide.points.data(slide.points.position);
        for (unsigned int p = 0; p < slide.points.size(); ++p)
          x[p] += creep;
        slide.sort();
        return 0.01;
      }),
                creep > 0.02 ? never : 5.5)
        << creep;
    }
}



// A point of a ten-thousandth of the mass may creep on, and is told.
TEST(RestDetector, StragglersMayCreep)
{
  using namespace rest_test;
  for (const double mass : {1e-4, 1.})
    {
      Slide             slide(2.);
      talus::Points<2> &points   = slide.points;
      const auto        is_first = [&](const unsigned int p) {
        return points.data(points.id)[p] == 0;
      };
      for (unsigned int p = 0; p < points.size(); ++p)
        if (is_first(p))
          points.data(points.mass)[p] = mass;
      EXPECT_EQ(slide.time_of_rest([&](const double /*t*/) {
        for (unsigned int p = 0; p < points.size(); ++p)
          if (is_first(p))
            points.data(points.position)[p] += 0.03;
        slide.sort();
        return 0.01;
      }),
                mass < 1. ? 5.5 : never);
      EXPECT_EQ(contains(slide.rest.sentence(5.5, 100.), "creep on outside"),
                mass < 1.);
    }
}



// Soil that has not moved by a cell, for instance a settling column, is never
// reported as at rest.
TEST(RestDetector, SoilThatHasNotSlidIsNoSlide)
{
  using namespace rest_test;
  Slide column(0.5);
  EXPECT_EQ(column.time_of_rest(slow), never);
  EXPECT_EQ(column.rest.sentence(20., 20.), "");
}



TEST(RestDetector, MotionAtTheEndIsTold)
{
  using namespace rest_test;
  Slide slide(2.);
  EXPECT_EQ(slide.time_of_rest([](const double) { return 0.5; }), never);
  EXPECT_TRUE(contains(slide.rest.sentence(20., 20.),
                       "The soil still moves at the end of the run, t = 20 s: "
                       "the kinetic energy is 0.25 of the maximum."));
  Quantities list;
  slide.rest.list_quantities(list);
  EXPECT_EQ(list.at(0).value, 0.);
}



// Without points there is rest only if points could leave through a face.
TEST(RestDetector, AllSoilHasLeft)
{
  using namespace rest_test;
  Slide slide(2., /*has_soil=*/false);
  EXPECT_FALSE(slide.is_at_rest(1., 0.));
  slide.outflow.open({{false, true, false, false}});
  EXPECT_TRUE(slide.is_at_rest(1.25, 0.));
  EXPECT_TRUE(contains(slide.rest.sentence(1.25, 9.),
                       "All soil has left the mesh through faces of outflow by "
                       "t = 1.25 s."));
}
