// SPDX-License-Identifier: LGPL-2.1-or-later
// Pipes along lines of the plan, and shapes whose places are on the map.

#include <talus/contact/ground.h>
#include <talus/contact/obstacle_remarks.h>
#include <talus/geometry/expression_surface.h>
#include <talus/geometry/pipe.h>
#include <talus/geometry/pipe_parameters.h>

#include "core_setup.h"
#include "obstacles_setup.h"

#include <random>

namespace pipe_test
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  /// Surfaces of a case whose mesh lies far from the origin of the map: without
  /// names, and cut along a line with a corner.
  template <int dim>
  struct PlainSurfaces : SurfaceSource<dim>
  {
    std::shared_ptr<const Surface<dim>>
    surface(const std::string &path,
            const std::string &expression) const override
    {
      using Named = typename ExpressionSurface<dim>::Named;
      return std::make_shared<ExpressionSurface<dim>>(path,
                                                      expression,
                                                      constants,
                                                      std::vector<Named>());
    }

    const Point<3> &
    origin() const override
    {
      return place;
    }

    std::vector<Point<2>>
    section(const std::string & /*path*/) const override
    {
      return {{5e5, 6.5e6},
              {5e5 + 30., 6.5e6 + 40.},
              {5e5 + 130., 6.5e6 + 40.}};
    }

    std::vector<Point<2>>
    read_route(const std::string & /*path*/,
               const std::string & /*file*/) const override
    {
      return {{500011., 6500023.}, {500019., 6500017.}};
    }

    FreshParameters fresh;
    Constants       constants;
    Point<3>        place{512000., 6742800., -300.};
  };



  /// The smallest of the distances to segments, one by one.
  double
  distance_to_line(const Point<3> &x, const std::vector<Point<3>> &line)
  {
    double result = std::numeric_limits<double>::max();
    for (std::size_t i = 1; i < line.size(); ++i)
      {
        const Tensor<1, 3> d = line[i] - line[i - 1];
        const double       s =
          std::clamp((x - line[i - 1]) * d / d.norm_square(), 0., 1.);
        result = std::min(result, x.distance(line[i - 1] + s * d));
      }
    return result;
  }



  /// A line that turns at random, and meets itself.
  std::vector<Point<3>>
  wild_line(const unsigned int n, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> number(-1., 1.);
    std::vector<Point<3>>                  line(1);
    for (unsigned int i = 0; i < n; ++i)
      line.push_back(line.back() + Point<3>(number(random),
                                            0.2 * number(random),
                                            number(random)));
    return line;
  }



  /// Places in and around the box of a shape.
  Point<3>
  draw_around(const Shape<3> &shape, std::mt19937 &random)
  {
    std::uniform_real_distribution<double> share(-0.5, 1.5);
    const Box<3>                           box = shape.bounding_box();
    Point<3>                               x;
    for (unsigned int d = 0; d < 3; ++d)
      x[d] = box.lower[d] + share(random) * box.length(d);
    return x;
  }



  // Along x, and then along z.
  TEST(Pipe, ClosedForms)
  {
    const Pipe pipe({{0., 0., 0.}, {10., 0., 0.}, {10., 0., 5.}}, 0.5);
    EXPECT_DOUBLE_EQ(pipe.signed_distance({3., 2., 0.}), 1.5);
    EXPECT_EQ(pipe.normal({3., 2., 0.}), Point<3>(0., 1., 0.));
    EXPECT_DOUBLE_EQ(pipe.signed_distance({10., 0.2, 3.}), -0.3);
    // Beyond its ends, and about its outer corner.
    EXPECT_DOUBLE_EQ(pipe.signed_distance({-3., 4., 0.}), 4.5);
    EXPECT_DOUBLE_EQ(pipe.signed_distance({13., 0., -4.}), 4.5);
    EXPECT_NEAR((pipe.normal({13., 0., -4.}) - Point<3>(0.6, 0., -0.8)).norm(),
                0.,
                1e-15);
    // In its inner corner, where the segment along z is the nearer one.
    EXPECT_DOUBLE_EQ(pipe.signed_distance({9., 0., 2.}), 0.5);
    EXPECT_EQ(pipe.normal({9., 0., 2.}), Point<3>(-1., 0., 0.));
    // On the axis any direction across it.
    const Tensor<1, 3> normal = pipe.normal({5., 0., 0.});
    EXPECT_DOUBLE_EQ(normal.norm(), 1.);
    EXPECT_EQ(normal[0], 0.);
    const Box<3> box = pipe.bounding_box();
    EXPECT_EQ(box.lower, Point<3>(-0.5, -0.5, -0.5));
    EXPECT_EQ(box.upper, Point<3>(10.5, 0.5, 5.5));
    EXPECT_EQ(pipe.width(), 1.);
  }



  // The index of its pieces leaves none out.
  TEST(Pipe, DistanceIsToTheNearestOfAllPieces)
  {
    std::mt19937 random(3);
    const auto   line = wild_line(400, random);
    const Pipe   pipe(line, 0.3);
    for (unsigned int i = 0; i < 2000; ++i)
      {
        const Point<3> x              = draw_around(pipe, random);
        const auto [distance, normal] = pipe.distance_and_normal(x);
        EXPECT_NEAR(distance, distance_to_line(x, line) - 0.3, 1e-12);
        EXPECT_EQ(distance, pipe.signed_distance(x));
        // The way along the normal ends on the axis.
        EXPECT_NEAR(distance_to_line(x - (distance + 0.3) * normal, line),
                    0.,
                    1e-12);
      }
  }



  TEST(Pipe, DistancesTurnWithTheRoute)
  {
    std::mt19937 random(5);
    const auto   line = wild_line(60, random);
    const double c = std::cos(0.7), s = std::sin(0.7);
    const auto   turned = [&](const Point<3> &x) {
      return Point<3>(c * x[0] - s * x[2] + 40.,
                      x[1] - 7.,
                      s * x[0] + c * x[2]);
    };
    auto turned_line = line;
    std::transform(line.begin(), line.end(), turned_line.begin(), turned);
    const Pipe pipe(line, 0.2), turned_pipe(turned_line, 0.2);
    for (unsigned int i = 0; i < 500; ++i)
      {
        const Point<3> x = draw_around(pipe, random);
        EXPECT_NEAR(pipe.signed_distance(x),
                    turned_pipe.signed_distance(turned(x)),
                    1e-12);
      }
  }



  // A section with a corner at x = 50 that goes on beyond its ends.
  TEST(SectionLine, CrossingsAreAtTheirLengths)
  {
    const std::vector<Point<2>> section = {{0., 0.}, {30., 40.}, {130., 40.}};
    const auto                  at = [&](const Point<2> &a, const Point<2> &b) {
      const auto            crossings = find_crossings(section, {a, b});
      const SectionCrossing none{std::nan(""), 0.};
      return crossings.size() == 1 ? crossings[0] : none;
    };
    // Square to the first leg, in its middle and behind its beginning.
    EXPECT_NEAR(at({15. - 4., 20. + 3.}, {15. + 4., 20. - 3.}).length,
                25.,
                1e-12);
    EXPECT_NEAR(at({15. - 4., 20. + 3.}, {15. + 4., 20. - 3.}).sine, 1., 1e-15);
    EXPECT_NEAR(at({-3. - 4., -4. + 3.}, {-3. + 4., -4. - 3.}).length,
                -5.,
                1e-12);
    // At 30 degrees to the second one, and beyond its end.
    EXPECT_NEAR(at({60., 40. - 10.}, {60. + 20. * std::sqrt(3.), 50.}).sine,
                0.5,
                1e-15);
    EXPECT_NEAR(at({60., 30.}, {60. + 20. * std::sqrt(3.), 50.}).length,
                50. + 30. + 10. * std::sqrt(3.),
                1e-12);
    EXPECT_NEAR(at({140., 50.}, {140., 30.}).length, 160., 1e-12);
    // Through the corner, once; from a corner of the route on the line, once.
    EXPECT_NEAR(at({30., 30.}, {30., 50.}).length, 50., 1e-12);
    EXPECT_EQ(
      find_crossings(section, {{60., 30.}, {60., 40.}, {60., 50.}}).size(), 1u);
    EXPECT_EQ(
      find_crossings(section, {{60., 30.}, {60., 40.}, {70., 30.}}).size() % 2,
      0u);
    // Along it, and beside it.
    EXPECT_TRUE(find_crossings(section, {{60., 40.}, {90., 40.}}).empty());
    EXPECT_TRUE(find_crossings(section, {{60., 41.}, {90., 45.}}).empty());
    EXPECT_EQ(
      find_crossings(section, {{60., 30.}, {70., 50.}, {80., 30.}}).size(), 2u);
  }



  // On a plane the axis is straight, however many pieces it has.
  TEST(Pipe, AxisFollowsTheHeightAlongTheRoute)
  {
    const PlainSurfaces<3> surfaces;
    const WithObstacles<3> with(
      {{"pipe",
        "Shape = pipe|Radius = 0.4|Height of axis = 0.1*x - 0.2*z + 3|"
        "Route = 10, 4; 50, 34"}},
      &surfaces);
    const Pipe   straight({{10., 3.2, 4.}, {50., 1.2, 34.}}, 0.4);
    std::mt19937 random(7);
    for (unsigned int i = 0; i < 300; ++i)
      {
        const Point<3> x = draw_around(straight, random);
        EXPECT_NEAR(with.obstacles[0].signed_distance(x),
                    straight.signed_distance(x),
                    1e-12);
      }
    EXPECT_TRUE(
      contains(with.obstacles.facts().at(0),
               "The obstacle 'pipe' is a pipe of 50.04 m, from (10 "
               "3.2 4) to (50 1.2 34) m; its axis has y from 1.2 m to "
               "3.2 m."))
      << with.obstacles.facts().at(0);
    EXPECT_EQ(with.obstacles.remarks().at(0), "");
  }



  // Entries in the axes of the mesh, and the same places on the map: the origin
  // is easting 512000, northing 6742800, height -300.
  TEST(Coordinates, ShapesOnTheMapAreThoseOfTheMesh)
  {
    const std::vector<std::pair<std::string, std::string>> pairs = {
      {"Shape = box|Lower corner = 1, 2, 3|Upper corner = 5, 4, 9",
       "Shape = box|Lower corner = 512001, 6742791, -298|"
       "Upper corner = 512005, 6742797, -296"},
      {"Shape = ball|Centre = 4, 2, 5|Radius = 3|Reference point = 1, 2, 3",
       "Shape = ball|Centre = 512004, 6742795, -298|Radius = 3|"
       "Reference point = 512001, 6742797, -298"},
      {"Shape = cylinder|Centre = 4, 2, 0|Radius = 2|Extent in z = 1, 6",
       "Shape = cylinder|Centre = 512004, 6742800, -298|Radius = 2|"
       "Extent in z = 6742794, 6742799"},
      {"Shape = half-plane|Point = 4, 2, 1|Normal = 1, 2, 3",
       "Shape = half-plane|Point = 512004, 6742799, -298|Normal = 1, -3, 2"},
      {"Shape = polygon|Vertices = 0,0; 6,1; 3,4|Extent in z = 2, 7",
       "Shape = polygon|Vertices = 512000,-300; 512006,-299; 512003,-296|"
       "Extent in z = 6742793, 6742798"},
      {"Shape = layer|Upper surface = 4 + 0.1*x|Lower surface = 1|"
       "Vertices = 0,0; 6,1; 3,8|Lower corner = 0.5, 0, 1|"
       "Upper corner = 5, 0, 6",
       "Shape = layer|Upper surface = 4 + 0.1*x|Lower surface = 1|"
       "Vertices = 512000,6742800; 512006,6742799; 512003,6742792|"
       "Lower corner = 512000.5, 6742794, 0|Upper corner = 512005, 6742799, 0"},
      {"Shape = pipe|Route = 0,1; 4,6; 9,2|Radius = 0.5|"
       "Height of axis = 2 + 0.1*z",
       "Shape = pipe|Route = 512000,6742799; 512004,6742794; 512009,6742798|"
       "Radius = 0.5|Height of axis = 2 + 0.1*z"}};
    std::mt19937                           random(11);
    std::uniform_real_distribution<double> number(-2., 10.);
    for (const auto &[of_mesh, of_map] : pairs)
      {
        SCOPED_TRACE(of_mesh);
        const PlainSurfaces<3> surfaces;
        const WithObstacles<3> with({{"a", of_mesh},
                                     {"b", "Coordinates = map|" + of_map}},
                                    &surfaces);
        const auto            &a = with.obstacles[0], &b = with.obstacles[1];
        unsigned int           n_inside = 0;
        for (unsigned int i = 0; i < 400; ++i)
          {
            const Point<3> x(number(random), number(random), number(random));
            EXPECT_NEAR(a.signed_distance(x), b.signed_distance(x), 1e-9);
            n_inside += a.signed_distance(x) < 0.;
          }
        EXPECT_GT(n_inside, 0u);
        EXPECT_NEAR(a.reference_point().distance(b.reference_point()),
                    0.,
                    1e-9);
      }
  }



  TEST(Coordinates, ASectionHasNoMap)
  {
    const PlainSurfaces<2> surfaces;
    EXPECT_TRUE(
      contains(message_of<ExcUser>([&] {
                 const WithObstacles<2> with(
                   {{"a", "Shape = ball|Coordinates = map"}}, &surfaces);
               }),
               "'Obstacles/a/Coordinates' is 'map', but the simulation "
               "is two-dimensional"));
  }



  /// A pipe in a section, and what is said of it.
  struct InSection
  {
    std::string error, fact, remark;
    Point<2>    centre;
    double      radius = 0.;
  };



  InSection
  in_section(const std::string &entries)
  {
    InSection              result;
    const PlainSurfaces<2> surfaces;
    result.error = message_of<ExcUser>([&] {
      const WithObstacles<2> with({{"p",
                                    "Shape = pipe|Radius = 0.5|"
                                    "Height of axis = 0.1*x - 200|" +
                                      entries}},
                                  &surfaces);
      result.fact   = with.obstacles.facts().at(0);
      result.remark = with.obstacles.remarks().at(0);
      result.centre = with.obstacles[0].reference_point();
      result.radius = -with.obstacles[0].signed_distance(result.centre);
    });
    return result;
  }



  // On the line of the section, at 25 m of it and square to it; then oblique.
  TEST(Pipe, InASectionADiscStandsWhereTheRouteCrosses)
  {
    const auto square =
      in_section("Coordinates = map|Route = 500011, 6500023; 500019, 6500017");
    EXPECT_EQ(square.error, "");
    EXPECT_NEAR(square.centre.distance(Point<2>(25., -197.5)), 0., 1e-8);
    EXPECT_NEAR(square.radius, 0.5, 1e-12);
    EXPECT_EQ(square.fact,
              "The obstacle 'p' crosses the section at x = 25 m, y = -197.5 m, "
              "at 90 degrees.");
    EXPECT_EQ(square.remark, "");
    const auto oblique = in_section("Route = 30, -10; 40, 10"); // of z = 0
    EXPECT_EQ(oblique.error, "");
    EXPECT_NEAR(oblique.centre.distance(Point<2>(35., -196.5)), 0., 1e-12);
    EXPECT_TRUE(contains(oblique.fact, "at 63.4 degrees")) << oblique.fact;
    EXPECT_TRUE(contains(oblique.remark, "ellipse, 1.12 times as long as high"))
      << oblique.remark;
  }



  TEST(Pipe, RoutesThatCannotBeAreRefused)
  {
    const auto expect = [](const std::string &entries,
                           const std::string &part) {
      const std::string said = in_section(entries).error;
      EXPECT_TRUE(contains(said, part)) << said;
      EXPECT_TRUE(contains(said, "'Obstacles/p/")) << said;
    };
    expect("Route =", "has 0 corners");
    expect("Route = 3, 4", "has 1 corners");
    expect("Route = 3, 4; 3, 4; 5, -5", "twice in succession");
    expect("Route = 3, 4; 3", "contains '3', where two numbers");
    expect("Route = 3, 4; 6, 8", "does not cross the section, z = 0");
    expect("Route = 3, 4; 4, -4; 5, 4", "at x = 3.5 m, at x = 4.5 m");
    expect("Route = 0, -5; 10, 4", "at 42 degrees");
    expect("Route = 3, 4; 3, -4|Height of axis =",
           "'Obstacles/p/Height of axis'");
  }



  // The box of an oblique pipe is large along all axes.
  TEST(Pipe, AnObliquePipeIsAsThinAsItIs)
  {
    const auto said = [](const std::string &radius) {
      const Core<3>          core(mesh("0, 0, 0", "8, 4, 8"));
      const PlainSurfaces<3> surfaces;
      const WithObstacles<3> with(
        {{"pipe",
          "Shape = pipe|Height of axis = 1 + 0.2*x|Route = 1, 1; 7, 7|"
          "Radius = " +
            radius}},
        &surfaces);
      std::vector<Remark> notes;
      const std::string   error = message_of<ExcUser>(
        [&] { notes = check_obstacle_sizes(with.obstacles, core.grid); });
      return error.empty() && !notes.empty() ? notes[0].text() : error;
    };
    EXPECT_TRUE(contains(said("0.4"), "only 0.8 m across and 0.8 m across"))
      << said("0.4");
    EXPECT_TRUE(contains(said("0.9"), "less than two cells of 1 m"))
      << said("0.9");
    EXPECT_EQ(said("1"), "");
  }



  // Nor one that reaches from one corner of the mesh to the other.
  TEST(Pipe, IsNoGround)
  {
    const PlainSurfaces<3> surfaces;
    const WithObstacles<3> with(
      {{"pipe",
        "Shape = pipe|Height of axis = 3 - 0.5*x|Radius = 1|"
        "Route = -1, -1; 9, 9"}},
      &surfaces);
    const Ground<3> ground({Point<3>(0, 0, 0), Point<3>(8, 4, 8)},
                           &with.obstacles);
    EXPECT_FALSE(ground.contains(0));
    EXPECT_EQ(ground.elevation(Point<3>(2, 3.5, 2)), 0.);
    EXPECT_FALSE(ground.is_open(Point<3>(2, 2, 2)));
  }
} // namespace pipe_test
