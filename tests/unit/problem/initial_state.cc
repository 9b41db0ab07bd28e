// SPDX-License-Identifier: LGPL-2.1-or-later
// Displacement, velocity and stress at the start, by expressions.

#include <talus/materials/materials.h>
#include <talus/problem/initial_state.h>

#include "core_setup.h"

namespace initial_state_test
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  /// A body of @p law in 2-D and a second body, both with points at random
  /// places.
  struct Started : Core<2>
  {
    explicit Started(const std::string &entries,
                     const std::string &law = "linear elastic")
      : Core<2>(cube<2>(), {}, MPI_COMM_SELF)
      , materials({{"soil", law}})
      , initial("/Bodies/slide")
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        in_section("Bodies", in_section("slide", entries)) +
        in_section("Materials",
                   in_section("soil",
                              "set Young's modulus = 2.6e6\n"
                              "set Poisson's ratio = 0.3")));
      ParameterAcceptor::parse_all_parameters();
      materials.assign({"slide", "other"}, {"soil", "soil"});
      materials.add_columns(points);
      for (unsigned int i = 0; i < 20; ++i)
        add(place(1.), Point<2>(0.5, 0.25), /*body=*/i % 2);
      materials.of_body(0).initialize(points, 0, points.size());
    }

    void
    deform(const BoxRule rule = BoxRule::fixed)
    {
      initial.check(materials.of_body(0));
      initial.deform(
        points, 0, points.size(), materials.of_body(0), rule, named);
    }

    double
    stress_component(const unsigned int c, const unsigned int p) const
    {
      return points.data(points.stress, c)[p];
    }

    Constants       named;
    Materials<2>    materials;
    InitialState<2> initial;
  };



  /// Complaint about @p entries of a body of @p law.
  std::string
  complaint(const std::string &entries, const std::string &law)
  {
    Started body(entries, law);
    return message_of<ExcUser>([&]() { body.deform(); });
  }
} // namespace initial_state_test



// x goes to x + 0.01 x y + 0.002 x^3: derivatives by differences of sixth order
// are exact but for round-off.
TEST(InitialState, DisplacementAndItsGradient)
{
  using namespace initial_state_test;
  Started body(
    "set Initial displacement = 0.01*x*y + 0.002*x^3; 0.03*x-0.02*y");
  EXPECT_TRUE(body.initial.is_displaced());
  body.deform();
  for (unsigned int p = 0; p < body.points.size(); ++p)
    {
      const Tensor<1, 2> X = body.get(body.points.initial_position, p);
      const Tensor<1, 2> x = body.get(body.points.position, p);
      EXPECT_NEAR(x[0],
                  X[0] + 0.01 * X[0] * X[1] + 0.002 * X[0] * X[0] * X[0],
                  1e-14);
      EXPECT_NEAR(x[1], X[1] + 0.03 * X[0] - 0.02 * X[1], 1e-14);
      Tensor<2, 2> F;
      F[0][0] = 1. + 0.01 * X[1] + 0.006 * X[0] * X[0];
      F[0][1] = 0.01 * X[0];
      F[1][0] = 0.03;
      F[1][1] = 0.98;
      EXPECT_LT((body.deformation(p) - F).norm(), 1e-11);
      for (unsigned int c = 0; c < n_stress_components<2>; ++c)
        EXPECT_EQ(body.stress_component(c, p), 0.);
    }
}



// Boxes stretch with the soil; edges keep their lengths in a rotation.
TEST(InitialState, StretchOfTheBoxes)
{
  using namespace initial_state_test;
  Started stretched("set Initial displacement = 0.2*x; -0.1*y");
  stretched.deform(BoxRule::second_moments);
  Started turned("set Initial displacement = (cos(0.3)-1)*x - sin(0.3)*y; "
                 "sin(0.3)*x + (cos(0.3)-1)*y");
  turned.deform(BoxRule::second_moments);
  for (unsigned int p = 0; p < stretched.points.size(); ++p)
    for (const unsigned int column :
         {stretched.points.box_length, stretched.points.length_at_creation})
      {
        EXPECT_LT((stretched.get(column, p) - Point<2>(0.6, 0.225)).norm(),
                  1e-11);
      }
  const unsigned int at_creation = turned.points.length_at_creation;
  for (unsigned int p = 0; p < turned.points.size(); ++p)
    EXPECT_LT((turned.get(at_creation, p) - Point<2>(0.5, 0.25)).norm(), 1e-11);
}



// sigma = mu (b - 1)/J + lambda ln J/J, with mu = 1 MPa and lambda = 1.5 MPa.
TEST(InitialState, StressOfANeoHookeanBody)
{
  using namespace initial_state_test;
  Started body("set Initial displacement = 0.2*x; -0.1*y", "neo-Hookean");
  body.deform();
  const double J = 1.2 * 0.9, pressure = 1.5e6 * std::log(J) / J;
  for (unsigned int p = 0; p < body.points.size(); ++p)
    {
      EXPECT_NEAR(body.stress_component(0, p),
                  1e6 * (1.44 - 1.) / J + pressure,
                  1e-4);
      EXPECT_NEAR(body.stress_component(1, p),
                  1e6 * (0.81 - 1.) / J + pressure,
                  1e-4);
      EXPECT_NEAR(body.stress_component(2, p), pressure, 1e-4);
      EXPECT_NEAR(body.stress_component(3, p), 0., 1e-4);
    }
}



// A function of the place without displacement, as all initial fields.
TEST(InitialState, StressByExpression)
{
  using namespace initial_state_test;
  Started body("set Initial stress = -2*y; -3*y; x; x*y\n"
               "set Initial displacement = 0.1; 0.2");
  body.deform();
  for (unsigned int p = 0; p < body.points.size(); ++p)
    {
      const Tensor<1, 2>          X = body.get(body.points.initial_position, p);
      const std::array<double, 4> expected = {
        {-2. * X[1], -3. * X[1], X[0], X[0] * X[1]}};
      for (unsigned int c = 0; c < 4; ++c)
        EXPECT_NEAR(body.stress_component(c, p), expected[c], 1e-14);
      EXPECT_LT(
        (body.get(body.points.position, p) - X - Point<2>(0.1, 0.2)).norm(),
        1e-14);
    }
}



TEST(InitialState, VelocityOfOneBodyAtATime)
{
  using namespace initial_state_test;
  Started body("set Initial velocity = x + 10*t; -y*t");
  body.initial.set_velocity(body.points, 1, 0.5, body.named);
  for (unsigned int p = 0; p < body.points.size(); ++p)
    {
      const Tensor<1, 2> X = body.get(body.points.initial_position, p);
      const Tensor<1, 2> v = body.get(body.points.velocity, p);
      if (body.points.data(body.points.body)[p] == 0.)
        {
          EXPECT_EQ(v.norm(), 0.);
        }
      else
        {
          EXPECT_LT((v - Point<2>(X[0] + 5., -0.5 * X[1])).norm(), 1e-14);
        }
    }
}



TEST(InitialState, MistakesAreRefused)
{
  using namespace initial_state_test;
  const auto expect = [](const std::string &entries,
                         const std::string &law,
                         const std::string &part) {
    const std::string said = complaint(entries, law);
    EXPECT_TRUE(contains(said, part)) << entries << ": " << said;
  };
  expect("set Initial displacement = -2*x; 0",
         "linear elastic",
         "turns the body inside out at");
  expect("set Initial displacement = -0.995*x; 0",
         "linear elastic",
         "to 0.005 times its volume");
  expect("set Initial displacement = 200*x; 0",
         "linear elastic",
         "to 201 times its volume");
  expect("set Initial stress = 0; 0; 0; 0\nset K0 = 0.5",
         "linear elastic",
         "a body starts with one stress");
  expect("set K0 = 0.5", "neo-Hookean", "'Bodies/slide/K0' is given, but the");
  expect("set Initial stress = 0; 0; 0; 0",
         "neo-Hookean",
         "'Bodies/slide/Initial stress' is given, but the");
}
