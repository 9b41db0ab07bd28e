// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/static_contact.h>

#include "equilibrium_setup.h"

namespace
{
  using Force = Tensor<1, 2>; // or another vector

  constexpr double g = 10.;

  /// Parameters of the seabed at the bottom.
  std::string
  seabed(const double       friction,
         const double       largest_stress,
         const std::string &other_faces = "")
  {
    return in_section("Boundaries",
                      other_faces + "set Bottom = seabed\n" +
                        in_section("Seabed",
                                   text("set Friction coefficient = ",
                                        friction,
                                        "\nset Maximum shear stress = ",
                                        largest_stress)));
  }



  /// An elastic block from @p begin to x = 4 m, 1 m high, under @p gravity.
  struct BlockOnSeabed : Statics<2>
  {
    explicit BlockOnSeabed(const std::string &below,
                           const Force       &gravity,
                           const double       begin = 2.,
                           const std::string &law   = stiff)
      : Statics<2>(mesh("0, 0", "6, 3", "0.5") + below,
                   {{"block", "linear elastic"}},
                   material("block", law) +
                     in_section("Equilibrium",
                                "set Newton tolerance = 1e-11\n"
                                "set Allowed imbalance = 1e-9"))
      , weight(density * (4. - begin) * gravity)
    {
      fill(Point<2>(begin, 0.),
           Point<2>(4., 1.),
           {{unsigned((4. - begin) * 4 + 0.5), 4}});
      load(gravity);
    }

    /// Force of the seabed on the soil at each of its nodes, by place; in
    /// equilibrium that is what the explicit scheme has out of balance there.
    std::map<double, Force>
    reactions()
    {
      StaticProblem<2> all = problem();
      sum_forces(all);
      const auto              places = places_of_nodes(grid);
      std::map<double, Force> result;
      for (const unsigned int node : nodes.active_nodes())
        if (nodes.mass(node) > constants.mass_cutoff && places[node][1] == 0.)
          result[places[node][0]] = -force(node);
        else if (nodes.mass(node) > constants.mass_cutoff &&
                 places[node][0] > 0.)
          {
            EXPECT_LT(force(node).norm(), 1e-8 * weight.norm());
          }
      return result;
    }

    Force weight; ///< N
  };



  Force
  inclined(const double slope)
  {
    const double beta = std::atan(slope);
    return Point<2>(g * std::sin(beta), -g * std::cos(beta));
  }



  Force
  sum(const std::map<double, Force> &reactions)
  {
    Force result;
    for (const auto &entry : reactions)
      result += entry.second;
    return result;
  }
} // namespace



TEST(StaticContactTest, BlockSticksToAnIncline)
{
  for (const double slope : {0., 0.2, 0.4})
    {
      BlockOnSeabed block(seabed(0.5, 1e9), inclined(slope));
      EXPECT_TRUE(block.find()) << block.equilibrium.failure();
      const auto reactions = block.reactions();
      EXPECT_EQ(reactions.size(), 5u);
      EXPECT_LT((sum(reactions) + block.weight).norm(),
                1e-8 * block.weight.norm());
      for (const auto &[x, reaction] : reactions)
        {
          EXPECT_GE(reaction[1], -1e-6 * block.weight.norm()) << x;
          EXPECT_LE(std::abs(reaction[0]),
                    0.5 * reaction[1] + 1e-5 * block.weight.norm())
            << x;
        }
    }
}



TEST(StaticContactTest, BlockSlidesOffWhenFrictionIsTooLittle)
{
  // tan(beta) = 0.2; the shear stress to hold it is 1500 g sin(beta) on each
  // square metre, 2942 Pa.
  for (const auto &[friction, largest_stress] :
       {std::pair(0.19, 1e9), {0.5, 2900.}, {0., 1e9}})
    {
      BlockOnSeabed block(seabed(friction, largest_stress), inclined(0.2));
      EXPECT_FALSE(block.find());
      EXPECT_TRUE(contains(block.equilibrium.failure(), "move freely"))
        << friction << ' ' << largest_stress << ": "
        << block.equilibrium.failure();
    }
  for (const auto &[friction, largest_stress] :
       {std::pair(0.21, 1e9), {0.5, 3000.}})
    {
      BlockOnSeabed block(seabed(friction, largest_stress), inclined(0.2));
      EXPECT_TRUE(block.find()) << block.equilibrium.failure();
      EXPECT_LT((sum(block.reactions()) + block.weight).norm(),
                1e-5 * block.weight.norm());
    }
}



TEST(StaticContactTest, BlockUnderUpwardLoadOpens)
{
  BlockOnSeabed block(seabed(0.5, 1e9, "set Left = fixed\n"),
                      Point<2>(0., 0.1 * g),
                      0.);
  EXPECT_TRUE(block.find()) << block.equilibrium.failure();
  for (const auto &[x, reaction] : block.reactions())
    if (x > 0.)
      {
        EXPECT_LT(reaction.norm(), 1e-8 * block.weight.norm()) << x;
      }
}



// Two seabeds meet in a corner, whose node is a place of both: neither force
// counts twice, in any number of load steps.
TEST(StaticContactTest, BlockInACornerOfTwoSeabeds)
{
  for (const unsigned int n_steps : {1, 4})
    {
      const Force   gravity = Point<2>(-0.6 * g, -g);
      BlockOnSeabed block(seabed(0.2, 1e9, "set Left = seabed\n"), gravity, 0.);
      StaticOptions options = block.equilibrium.options();
      options.n_load_steps  = n_steps;
      block.equilibrium.begin(options);
      while (!block.equilibrium.is_balanced())
        {
          StaticProblem<2> all = block.problem();
          ASSERT_TRUE(
            block.equilibrium.advance(all, [](const auto &) { return true; }))
            << block.equilibrium.failure();
        }
      StaticProblem<2> all = block.problem();
      sum_forces(all);
      const auto places = places_of_nodes(block.grid);
      Force      reaction;
      for (const unsigned int node : block.nodes.active_nodes())
        if (block.nodes.mass(node) > block.constants.mass_cutoff)
          {
            if (places[node][0] == 0. || places[node][1] == 0.)
              reaction -= block.force(node);
            else
              EXPECT_LT(block.force(node).norm(), 1e-8 * block.weight.norm());
          }
      EXPECT_LT((reaction + block.weight).norm(), 1e-8 * block.weight.norm());
    }
}



// A block that its own weight spreads: friction is at its limit at the ends and
// holds them back.
TEST(StaticContactTest, FrictionIsWithinItsLimit)
{
  for (const auto &[friction, cap] :
       {std::pair(10., 600.), {10., 100.}, {0.05, 1e9}, {0., 1e9}})
    {
      SCOPED_TRACE(text(friction, ", ", cap));
      BlockOnSeabed block(
        seabed(friction, cap),
        Point<2>(0., -g),
        2.,
        "set Young's modulus = 1e6\nset Poisson's ratio = 0.45\n");
      EXPECT_TRUE(block.find()) << block.equilibrium.failure();
      const auto   reactions = block.reactions();
      unsigned int n_limited = 0;
      for (const auto &[x, reaction] : reactions)
        {
          const double area  = (x == 2. || x == 4. ? 0.25 : 0.5);
          const double limit = std::min(friction * reaction[1], cap * area);
          const double small = 1e-6 * block.weight.norm();
          EXPECT_LE(std::abs(reaction[0]), limit + small) << x;
          if (std::abs(reaction[0]) > limit - small)
            ++n_limited;
          if (std::abs(reaction[0]) > small)
            {
              EXPECT_LT(reaction[0] * (x - 3.), 0.) << x;
            }
          // The block is symmetric.
          EXPECT_NEAR(reaction[1], reactions.at(6. - x)[1], small);
          EXPECT_NEAR(reaction[0], -reactions.at(6. - x)[0], small);
        }
      EXPECT_GE(n_limited, 2u);
    }
}



// Also while the load comes on, step by step: what the seabed bears belongs to
// the load that is on, R = f_int - load f_ext.
TEST(StaticContactTest, FrictionIsWithinItsLimitAtEachLoadStep)
{
  for (const auto &[friction, cap] :
       {std::pair(10., 600.), {10., 100.}, {0.05, 1e9}})
    {
      SCOPED_TRACE(text(friction, ", ", cap));
      BlockOnSeabed block(
        seabed(friction, cap),
        Point<2>(0., -g),
        2.,
        "set Young's modulus = 1e6\nset Poisson's ratio = 0.45\n");
      const double  small   = 1e-6 * block.weight.norm();
      StaticOptions options = block.equilibrium.options();
      options.n_load_steps  = 4;
      block.equilibrium.begin(options);
      for (unsigned int step = 1; step <= 4; ++step)
        {
          StaticProblem<2> all = block.problem();
          ASSERT_TRUE(
            block.equilibrium.advance(all, [](const auto &) { return true; }))
            << block.equilibrium.failure();
          const double load = block.equilibrium.load();
          EXPECT_NEAR(load, 0.25 * step, 1e-12);
          const auto places = places_of_nodes(block.grid);
          sum_forces(all);
          unsigned int n_limited = 0;
          for (const unsigned int node : block.nodes.active_nodes())
            {
              if (block.nodes.mass(node) <= block.constants.mass_cutoff)
                continue;
              const Force  weight   = block.nodes.mass(node) * Point<2>(0., -g);
              const Force  reaction = (1. - load) * weight - block.force(node);
              const double x        = places[node][0];
              const double area     = (x == 2. || x == 4. ? 0.25 : 0.5);
              const double limit = std::min(friction * reaction[1], cap * area);
              if (places[node][1] > 0.)
                {
                  EXPECT_LT(reaction.norm(), small);
                  continue;
                }
              EXPECT_LE(std::abs(reaction[0]), limit + 10. * small) << x;
              n_limited += std::abs(reaction[0]) > limit - 10. * small;
            }
          EXPECT_GE(n_limited, 2u);
        }
    }
}



// Bodies that spread on a flat seabed and are not symmetric. The first guess is
// that all nodes slip, which would let them go, though nothing pulls at them.
TEST(StaticContactTest, SpreadingBodiesStay)
{
  for (const double begin : {0.75, 1.75, 2.6, 3.3})
    for (const double cap : {30., 300., 1500., 5000.})
      {
        SCOPED_TRACE(text(begin, ", ", cap));
        BlockOnSeabed block(seabed(10., cap), Point<2>(0., -g), begin);
        EXPECT_TRUE(block.find()) << block.equilibrium.failure();
        const auto reactions = block.reactions();
        EXPECT_NEAR(sum(reactions)[0], 0., 1e-5 * block.weight.norm());
        for (const auto &[x, reaction] : reactions)
          EXPECT_LE(std::abs(reaction[0]),
                    0.5 * cap + 1e-6 * block.weight.norm())
            << x;
      }
}



namespace
{
  /// The state of one node in the middle of the seabed, with made-up reactions
  /// and displacements; all others are pressed on.
  struct NodeOnSeabed : BlockOnSeabed
  {
    NodeOnSeabed()
      : BlockOnSeabed(seabed(0.5, 150.), Point<2>(0., -g))
      , parts(*this, constants.mass_cutoff)
    {
      const auto places = places_of_nodes(grid);
      for (const unsigned int active : parts.unknowns.active_nodes())
        if (places[active] == Point<2>(3., 0.))
          node = active;
      const StaticProblem<2> all = problem();
      contact.begin(all, parts.unknowns, 1e6);
    }

    /// Forces of contact at all nodes, N.
    std::vector<double>
    forces()
    {
      auto forces = parts.unknowns.field();
      contact.add_forces(1., parts.unknowns.field(), forces);
      return forces;
    }

    /// Returns the number of changes; displacement becomes what update() left.
    unsigned int
    update(const Force &reaction, Force &displacement)
    {
      auto residual = forces(), u = parts.unknowns.field();
      for (const unsigned int n : parts.unknowns.active_nodes())
        residual[2 * n + 1] -= 100.;
      residual[2 * node + 1] += 100.;
      for (unsigned int d = 0; d < 2; ++d)
        {
          residual[2 * node + d] -= reaction[d];
          u[2 * node + d] = displacement[d];
        }
      const StaticProblem<2> all = problem();
      const unsigned int     n =
        contact.update(all, parts.unknowns, residual, u, 1e-5);
      for (unsigned int d = 0; d < 2; ++d)
        displacement[d] = u[2 * node + d];
      return n;
    }

    unsigned int
    update(const Force &reaction)
    {
      Force none;
      return update(reaction, none);
    }

    unsigned int
    held()
    {
      const StaticProblem<2> all = problem();
      return contact.held(all, parts.unknowns)[node];
    }

    /// Force of contact at the node, N.
    Force
    force()
    {
      const auto all = forces();
      return Point<2>(all[2 * node], all[2 * node + 1]);
    }

    StepParts<2>     parts;
    StaticContact<2> contact;
    unsigned int     node = 0;
  };
} // namespace



TEST(StaticContactTest, SticksUpToTheLimit)
{
  NodeOnSeabed one;
  EXPECT_EQ(one.held(), 3u);
  for (const Force reaction :
       {Point<2>(49.9, 100.), Point<2>(-49.9, 100.), Point<2>(0., 20.)})
    {
      EXPECT_EQ(one.update(reaction), 0u);
      EXPECT_EQ(one.held(), 3u);
      EXPECT_LT((one.force() - reaction).norm(), 1e-12);
    }
  EXPECT_EQ(one.update(Point<2>(-60., 100.)), 1u);
  EXPECT_EQ(one.held(), 2u);
  EXPECT_LT((one.force() - Point<2>(-50., 100.)).norm(), 1e-12);
  // The limit follows the normal force up to the cap times half a metre.
  EXPECT_EQ(one.update(Point<2>(0., 120.)), 1u);
  EXPECT_LT((one.force() - Point<2>(-60., 120.)).norm(), 1e-12);
  EXPECT_EQ(one.update(Point<2>(0., 400.)), 1u);
  EXPECT_LT((one.force() - Point<2>(-75., 400.)).norm(), 1e-12);
  EXPECT_EQ(one.update(Point<2>(0., 500.)), 0u);
}



TEST(StaticContactTest, SlipsAgainstTheFrictionOnly)
{
  NodeOnSeabed one;
  Force        against = Point<2>(1e-4, 0.), along = Point<2>(-1e-4, 0.);
  one.update(Point<2>(-60., 100.));
  EXPECT_EQ(one.update(Point<2>(0., 100.), against), 0u);
  EXPECT_EQ(one.held(), 2u);
  EXPECT_EQ(one.update(Point<2>(0., 100.), along), 1u);
  EXPECT_EQ(one.held(), 3u);
  EXPECT_EQ(one.update(Point<2>(30., 100.)), 0u);
  EXPECT_LT((one.force() - Point<2>(30., 100.)).norm(), 1e-12);
}



TEST(StaticContactTest, LiftsOffAndComesDown)
{
  NodeOnSeabed one;
  EXPECT_EQ(one.update(Point<2>(0., -1.)), 1u);
  EXPECT_EQ(one.held(), 0u);
  EXPECT_EQ(one.force().norm(), 0.);
  Force up = Point<2>(1e-3, 1e-3), into = Point<2>(1e-3, -1e-3);
  EXPECT_EQ(one.update(Point<2>(0., 0.), up), 0u);
  EXPECT_EQ(one.held(), 0u);
  EXPECT_EQ(one.update(Point<2>(0., 0.), into), 1u);
  EXPECT_EQ(one.held(), 3u);
  EXPECT_EQ(into[0], 1e-3);
  EXPECT_EQ(into[1], 0.);
}
