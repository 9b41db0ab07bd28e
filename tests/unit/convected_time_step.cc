#include <talus/simulation/time_step.h>

#include "equilibrium_setup.h"

namespace
{
  /// The step that one point allows, box of 0.3 m in cells of 1 m, over the time
  /// in which a wave crosses a cell.
  double
  relative_time_step(const Tensor<2, 3> &F)
  {
    Statics<3> statics(cube<3>() +
                         in_section("Transfer",
                                    "set Box rule = convected domain"),
                       {{"soil", "linear elastic"}},
                       material("soil", stiff + "set Density = 1500"));
    auto      &points = statics.points;
    const auto p =
      statics.add(Point<3>(2.5, 2.5, 2.5), Point<3>(0.3, 0.3, 0.3));
    points.data(points.mass)[p] = 1500.;
    statics.set_deformation(p, F);
    statics.sort();
    const double modulus = 1e6 * 0.7 / (1.3 * 0.4); // lambda + 2 mu
    return TimeStep<3>().choose(points,
                                statics.grid,
                                statics.materials,
                                statics.transfer.box_shape()) *
           std::sqrt(modulus / 1500.);
  }



  /// What counts is the width between opposite sides, 0.3 m/sqrt(2) after a
  /// shear of one, however the domain is turned.
  TEST(ConvectedDomains, TimeStepByTheWidth)
  {
    Tensor<2, 3> shear(dealii::unit_symmetric_tensor<3>()), turn = shear;
    shear[0][1] = 1.;
    turn[0][0] = turn[1][1] = std::cos(0.7);
    turn[0][1]              = -std::sin(0.7);
    turn[1][0]              = std::sin(0.7);
    const double expected =
      0.9 * 2. / std::sqrt(std::sqrt(2.) / 0.15 + 1. / 0.15 + 1. / 0.15);
    EXPECT_NEAR(relative_time_step(shear), expected, 1e-12);
    EXPECT_NEAR(relative_time_step(turn * shear), expected, 1e-12);
  }
} // namespace
