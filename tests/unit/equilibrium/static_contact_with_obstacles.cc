// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/static_contact.h>

#include "equilibrium_setup.h"

namespace
{
  constexpr double gravity_on_beds = 10.;

  /// An elastic block 2 m long and 1 m high on an obstacle that rises with the
  /// slope @p rise from (2, 0.6) m on: columns of points, each of which touches
  /// the surface with a corner.
  struct BlockOnBed : Statics<2>
  {
    BlockOnBed(const std::string &friction,
               const double       rise,
               const double       direction = 0.)
      : Statics<2>(mesh("0, 0", "6, 3", "0.5"),
                   {{"block", "linear elastic"}},
                   material("block", stiff) +
                     in_section("Equilibrium",
                                "set Newton tolerance = 1e-11\n"
                                "set Allowed imbalance = 1e-9") +
                     in_section("Obstacles",
                                in_section("bed",
                                           text("set Shape = half-plane\n"
                                                "set Point = 2, 0.6\n"
                                                "set Normal = ",
                                                -rise,
                                                ", 1\n") +
                                             friction)),
                   MPI_COMM_WORLD,
                   {"bed"})
    {
      const double g = gravity_on_beds;
      const auto   pull =
        Point<2>(g * std::sin(direction), -g * std::cos(direction));
      for (double x = 2.; x < 4.; x += 0.25)
        {
          const double bottom = 0.6 + rise * (x + 0.25 - 2.);
          fill(Point<2>(x, bottom), Point<2>(x + 0.25, bottom + 1.), {{1, 4}});
        }
      load(pull);
      weight = density * 2. * pull;
    }

    /// What facets pass to the soil, N; in each within the friction.
    Vector
    passed(const double coefficient) const
    {
      Vector result;
      for (unsigned int k = 0; k < contact.impulses().size(); ++k)
        {
          const ContactImpulse<2> &impulse = contact.impulses()[k];
          const Vector             n       = contact.facets().owned()[k].normal;
          EXPECT_GE(impulse.normal, 0.);
          EXPECT_LE(impulse.tangential.norm(),
                    coefficient * impulse.normal + 1e-9 * weight.norm());
          EXPECT_LT(std::abs(impulse.tangential * n), 1e-9 * weight.norm());
          result += impulse.normal * n + impulse.tangential;
        }
      return result;
    }

    Vector weight; ///< N
  };
} // namespace



// Facets that the mesh cuts anyhow bear the whole weight, and each no more than
// its friction.
TEST(StaticContactWithObstacles, BearTheWeightOfABlock)
{
  for (const double rise : {0., 0.1, 0.2})
    {
      SCOPED_TRACE(rise);
      BlockOnBed block("set Friction coefficient = 0.5\n", rise);
      ASSERT_TRUE(block.find()) << block.equilibrium.failure();
      EXPECT_LT((block.passed(0.5) + block.weight).norm(),
                1e-8 * block.weight.norm());
    }
}



// The block stays as long as the coefficient of friction is more than the slope
// of the bed, wherever in its cells that lies. (From the slope to
// ten per cent more, where nearly all facets are about to slip, the loops over
// the forces do not come to rest: what is found then is on the safe side.)
TEST(StaticContactWithObstacles, CoefficientThatHoldsABlock)
{
  for (const double rise : {0.1, 0.2})
    for (const double ratio : {0.98, 1.25})
      {
        SCOPED_TRACE(text(rise, ", ", ratio));
        BlockOnBed block(
          text("set Friction coefficient = ", ratio * rise, '\n'), rise);
        EXPECT_EQ(block.find(), ratio > 1.) << block.equilibrium.failure();
      }
}



// By hand: 1500 kg/m^3 x 1 m x 10 m/s^2 x sin(0.2) on each square metre.
TEST(StaticContactWithObstacles, ShearStressThatHoldsABlock)
{
  const double needed = 1500. * gravity_on_beds * std::sin(0.2);
  for (const double ratio : {0.99, 1.01})
    {
      BlockOnBed block(text("set Friction coefficient = 10\n"
                            "set Maximum shear stress = ",
                            ratio * needed,
                            '\n'),
                       0.,
                       0.2);
      EXPECT_EQ(block.find(), ratio > 1.) << block.equilibrium.failure();
    }
}



// What pulls soil off an obstacle meets no force: it must not stick to it.
TEST(StaticContactWithObstacles, SoilLiftsOff)
{
  BlockOnBed block("set Friction coefficient = 0.5\n", 0., M_PI);
  EXPECT_FALSE(block.find());
  EXPECT_LT(block.passed(0.5).norm(), 1e-12);
}
