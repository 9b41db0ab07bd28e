// SPDX-License-Identifier: LGPL-2.1-or-later
// An obstacle among many others is the obstacle that it is alone.

#include "equilibrium_setup.h"
#include "obstacles_setup.h"

namespace many_obstacles_test
{
  /// A row of balls of 0.8 m, one each 10 m (20 cells), on a bed, and soil
  /// around the ball at x = @p centre. Moving balls start
  /// @p way, m, before their places and arrive in one step.
  struct Row : Statics<2>
  {
    Row(const std::vector<double> &centres,
        const double               centre,
        const double               way = 0.)
      : Statics<2>(mesh("0, 0", "80, 4", "0.5"),
                   {{"soil", "linear elastic"}},
                   material("soil", stiff) + sections(centres, way),
                   MPI_COMM_WORLD,
                   names(centres))
    {
      for (double x = centre - 3.; x < centre + 3.; x += 0.25)
        for (double y = 0.5; y < 3.; y += 0.25)
          if (Point<2>(x + 0.125, y + 0.125).distance(Point<2>(centre, 1.7)) >
              0.9)
            fill(Point<2>(x, y), Point<2>(x + 0.25, y + 0.25), {{1, 1}});
      load(Point<2>(0., -10.));
      StaticProblem<2> all = problem();
      this->time_step      = 1.;
      contact.begin_step(*this);
      sum_forces(all);
      contact.find_constraints(*this);
    }

    static std::vector<std::string>
    names(const std::vector<double> &centres)
    {
      std::vector<std::string> result;
      for (const double centre : centres)
        result.push_back(text("ball ", centre));
      result.push_back("bed");
      return result;
    }

    static std::string
    sections(const std::vector<double> &centres, const double way)
    {
      std::string result =
        in_section("bed",
                   "set Shape = half-plane\nset Point = 0, 0.6\n"
                   "set Normal = 0, 1\n");
      for (const double centre : centres)
        result +=
          in_section(text("ball ", centre),
                     text("set Shape = ball\nset Centre = ",
                          centre - way,
                          ", 1.7\nset Radius = 0.8\n") +
                       (way == 0. ? ""
                                  : text("set Velocity = ", way, "; 0\n")));
      return in_section("Obstacles", result);
    }

    using Numbers = std::vector<double>;

    /// What the soil feels of ball and bed, facet by facet.
    std::vector<Numbers>
    loaded() const
    {
      std::vector<Numbers> result;
      for (const unsigned int c : contact.constraints().loaded())
        {
          const ContactFacet<2> &facet      = contact.facets().owned()[c];
          const auto            &constraint = contact.constraints()[c];
          result.push_back({facet.centroid[0],
                            facet.centroid[1],
                            facet.area,
                            facet.normal[0],
                            constraint.gap,
                            constraint.area,
                            constraint.normal_mass,
                            constraint.mass});
        }
      return result;
    }

    std::vector<Numbers>
    nodes_inside() const
    {
      std::vector<Numbers> result;
      for (const auto &inside : contact.facets().nodes_inside())
        if (nodes.mass(inside.node) > 0)
          result.push_back({inside.place[0],
                            inside.place[1],
                            contact.constraints().gap_inside(grid, inside)});
      return result;
    }
  };



  TEST(ManyObstacles, EachIsAsAlone)
  {
    for (const double centre : {10., 40., 70.})
      {
        SCOPED_TRACE(centre);
        const auto [facets, inside] = [centre]() {
          const Row alone({centre}, centre);
          return std::pair(alone.loaded(), alone.nodes_inside());
        }();
        EXPECT_GT(facets.size(), 10u);
        const Row among({10., 20., 30., 40., 50., 60., 70.}, centre);
        EXPECT_EQ(among.loaded(), facets);
        EXPECT_EQ(among.nodes_inside(), inside);
      }
  }



  // From places where they touch no soil, 2 m before: the mesh was prepared for
  // them there.
  TEST(ManyObstacles, EachIsAsAloneWhereItMovedTo)
  {
    const auto loaded = [](const double way) {
      return Row({40.}, 40., way).loaded();
    };
    const auto facets = loaded(2.);
    EXPECT_EQ(facets.size(), loaded(0.).size());
    const Row among({10., 20., 30., 40., 50., 60., 70.}, 40., 2.);
    EXPECT_EQ(among.loaded(), facets);
  }



  // Else the cost grows with the square of their number.
  TEST(ManyObstacles, TheIndexFollowsThoseThatMove)
  {
    const FreshParameters fresh;
    const auto            ball = [](const double x, const double y) {
      return text(
        "Shape = ball|Velocity = 5; 0|Radius = 0.5|Centre = ", x, ", ", y);
    };
    WithObstacles<2> with({{"a", ball(0., 0.)},
                           {"b", ball(10., 0.)},
                           {"c", ball(20., 0.)},
                           {"d", ball(30., 0.)},
                           {"e", ball(40., 0.)},
                           {"f", ball(50., 0.)}});
    using Numbers = std::vector<unsigned int>;
    EXPECT_EQ(with.obstacles.near(Point<2>(20., 1.), 1.), Numbers{2});
    with.obstacles.advance(0., 2.);
    EXPECT_EQ(with.obstacles.near(Point<2>(20., 1.), 1.), Numbers{1});
    EXPECT_EQ(with.obstacles.near(Point<2>(60., 1.), 1.), Numbers{5});
    EXPECT_EQ(with.obstacles.near(Point<2>(0., 1.), 1.), Numbers{});
  }
} // namespace many_obstacles_test
