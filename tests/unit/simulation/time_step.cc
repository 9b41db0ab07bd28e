// SPDX-License-Identifier: LGPL-2.1-or-later
// The three bounds of doc/method.md, section 8.

#include <talus/simulation/time_step.h>

#include <limits>

#include "equilibrium_setup.h"

namespace
{
  using dealii::Point;

  constexpr double rho     = 1500.;                    // kg/m^3
  const double     modulus = 1e6 * 0.7 / (1.3 * 0.4);  // lambda + 2 mu, Pa
  const double     c       = std::sqrt(modulus / rho); // m/s



  /// Points of stiff soil, and the step that they allow.
  template <int dim>
  struct Stepped : Statics<dim>
  {
    using Statics<dim>::points;

    /// @p entries are in the section of the time step.
    explicit Stepped(const std::string &entries = "",
                     const std::string &below   = "")
      : Statics<dim>(cube<dim>() + below,
                     {{"soil", "linear elastic"}},
                     material("soil", stiff + "set Density = 1500"))
    {
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Time step", entries));
      dealii::ParameterAcceptor::parse_all_parameters();
    }

    /// A point in the cell around @p x with a box of these lengths.
    unsigned int
    add(const Point<dim> &x, const Tensor<1, dim> &length)
    {
      const unsigned int p        = Statics<dim>::add(x, length);
      points.data(points.mass)[p] = rho * this->volume(p);
      return p;
    }

    /// The step that the points allow, s.
    double
    step()
    {
      this->sort();
      return time_step.choose(points,
                              this->grid,
                              this->materials,
                              this->transfer.box_shape());
    }

    std::string
    limited_by()
    {
      this->sort();
      return time_step.limited_by(points,
                                  this->grid,
                                  this->materials,
                                  this->transfer.box_shape());
    }

    TimeStep<dim> time_step;
  };



  const Point<2> middle(2.5, 2.5), whole(1., 1.);



  /// No point knows of the size of its box if it fills a cell.
  TEST(TimeStep, WaveAndFlowCrossAShareOfACell)
  {
    Stepped<2> soil("set CFL number = 0.25");
    const auto p = soil.add(middle, whole);
    EXPECT_NEAR(soil.step() * c, 0.25, 1e-15);
    soil.set(soil.points.velocity, p, Point<2>(-0.3 * c, 0.4 * c));
    EXPECT_NEAR(soil.step() * c, 0.25 / 1.5, 1e-15);
    EXPECT_TRUE(contains(soil.limited_by(),
                         "the wave and flow speed at point 0 (wave speed"));
  }



  /// c of the density that it has now.
  TEST(TimeStep, LighterSoilHasFasterWaves)
  {
    Stepped<2>   soil("set CFL number = 0.25",
                    in_section("Transfer", "set Box rule = fixed"));
    const auto   p = soil.add(middle, whole);
    Tensor<2, 2> F;
    F[0][0] = 1.44;
    F[1][1] = 1.;
    soil.set_deformation(p, F);
    EXPECT_NEAR(soil.step() * c, 0.25 / 1.2, 1e-15);
  }



  template <int dim>
  void
  expect_thin(const Tensor<1, dim> &length, const double sum_of_inverse_halves)
  {
    Stepped<dim> soil("set CFL number = 1\nset Box safety factor = 0.5");
    Point<dim>   x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 2.5;
    const auto   p        = soil.add(x, length);
    const double expected = 0.5 * 2. / std::sqrt(sum_of_inverse_halves);
    EXPECT_NEAR(soil.step() * c, expected, 1e-14);
    EXPECT_TRUE(contains(soil.limited_by(), "the thin box of point 0"));
    // This bound does not know the speed, and takes over from the other one.
    soil.set(soil.points.velocity, p, Point<dim>::unit_vector(0) * c);
    EXPECT_NEAR(soil.step() * c, std::min(expected, 0.5), 1e-14);
  }



  /// Half lengths below 0.1 h count as 0.1 h, above 0.5 h as 0.5 h.
  TEST(TimeStep, ThinBoxes)
  {
    expect_thin<2>(Point<2>(0.4, 0.8), 1. / 0.2 + 1. / 0.4);
    expect_thin<2>(Point<2>(0.02, 3.), 1. / 0.1 + 1. / 0.5);
    expect_thin<3>(Point<3>(0.3, 0.4, 0.5), 1. / 0.15 + 1. / 0.2 + 1. / 0.25);
  }



  /// By the thinnest axis: one, two and five boxes per cell.
  TEST(TimeStep, FreeSurface)
  {
    for (const auto &[half, expected] :
         {std::pair(0.5, std::sqrt(2. / (3. + std::sqrt(7.)))),
          {0.25, std::sqrt(2. / (4. + std::sqrt(6.)))},
          {0.1, std::sqrt(2. / (7. + std::sqrt(15.)))}})
      {
        Stepped<2> soil("set CFL number = 1\nset Box safety factor = 1");
        soil.add(middle, Point<2>(1., 2. * half));
        EXPECT_NEAR(soil.step() * c, expected, 1e-14);
        EXPECT_TRUE(contains(soil.limited_by(),
                             "the stability of free surfaces, below 'Time "
                             "step/CFL number', at the box of point 0"));
      }
  }



  /// Of cells of half the size the steps are half as long.
  TEST(TimeStep, ShortestOfAllPoints)
  {
    Stepped<2> soil("set CFL number = 0.25");
    EXPECT_EQ(soil.step(), std::numeric_limits<double>::infinity());
    refine_corner(soil);
    soil.add(middle, whole);
    EXPECT_NEAR(soil.step() * c, 0.25, 1e-15);
    for (unsigned int i = 0; i < 20; ++i)
      {
        soil.add(Point<2>(0.75, 0.75), whole * 0.5);
        soil.add(middle, whole);
        EXPECT_NEAR(soil.step() * c, 0.125, 1e-15) << i;
      }
  }



  TEST(TimeStep, Maximum)
  {
    Stepped<2> soil("set Maximum = 1e-6");
    soil.add(middle, whole);
    EXPECT_EQ(soil.step(), 1e-6);
    EXPECT_EQ(soil.limited_by(), "'Time step/Maximum'");
  }



  TEST(TimeStep, WithoutBoundIsNamed)
  {
    Stepped<2> soil;
    const auto p = soil.add(middle, whole);
    soil.points.data(soil.points.velocity)[p] =
      std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(contains(message_of<ExcPoint>([&] { soil.step(); }),
                         "box length are not finite and positive at point 0"));
  }



  TEST(TimeStep, LostInRoundOffIsNamed)
  {
    const auto reason = []() { return "'Time step/Maximum'"; };
    EXPECT_NO_THROW(check_time_advances(1e3, 1e-12, reason));
    EXPECT_TRUE(contains(message_of<ExcPoint>(
                           [&] { check_time_advances(1e3, 1e-14, reason); }),
                         "limited by 'Time step/Maximum', so that time stands "
                         "still"));
  }



  /// The step that one point allows, box of 0.3 m in cells of 1 m, over the
  /// time in which a wave crosses a cell.
  double
  relative_time_step(const Tensor<2, 3> &F)
  {
    Stepped<3> soil("",
                    in_section("Transfer", "set Box rule = convected domain"));
    soil.set_deformation(soil.add(Point<3>(2.5, 2.5, 2.5),
                                  Point<3>(0.3, 0.3, 0.3)),
                         F);
    return soil.step() * c;
  }



  /// What counts is the width between opposite sides, 0.3 m/sqrt(2) after a
  /// shear of one, however the domain is turned.
  TEST(TimeStep, ConvectedDomainsByTheirWidth)
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
