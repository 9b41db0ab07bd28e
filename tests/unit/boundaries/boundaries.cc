// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/reaction_table.h>

#include "one_node_setup.h"

namespace
{
  TEST(Boundaries, FreeFaceDoesNothing)
  {
    const OneNode<2> n("", law(7., 1e9), on_bottom, 2., before, trial);
    n.expect_velocity(trial);
    n.expect_impulses(Point<2>(), Point<2>());
  }



  TEST(Boundaries, RollerHoldsTheNormalBothWays)
  {
    for (const double v_n : {-0.5, 0.5})
      {
        const OneNode<2> n(
          "set Bottom = roller", "", on_bottom, 2., before, Point<2>(3., v_n));
        n.expect_velocity(Point<2>(3., 0.));
        n.expect_impulses(Point<2>(), Point<2>(0., -2. * v_n));
        EXPECT_EQ(n.friction_work(), 0.);
        EXPECT_NEAR(n.contact_work(), 2. * v_n * 0.5 * -0.2, 1e-14);
      }
  }



  TEST(Boundaries, FixedHoldsAll)
  {
    OneNode<2> n("set Bottom = fixed", "", on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(0., 0.));
    n.expect_impulses(Point<2>(), -2. * trial);
    const double work = 2. * trial * (0.5 * before);
    EXPECT_NEAR(n.contact_work(), work, 1e-14);

    // A held face bears the force; a pass of the filter takes the momentum.
    n.constants.held_faces = n.boundaries.fixed_faces();
    n.set_node(2., 1e3, before, 2. * (trial - before) / dt);
    n.step();
    n.expect_velocity(Point<2>(0., 0.));
    EXPECT_EQ(n.nodes.increment(n.node).norm(), 0.);
    n.expect_impulses(Point<2>(), -2. * trial - 2. * (trial - before));
    n.set_node(2., 1e3, before, {});
    n.nodes.update_momentum(0., 0.);
    n.boundaries.hold_nodes(n, true);
    n.expect_impulses(Point<2>(), -4. * trial);
    EXPECT_NEAR(n.contact_work(), work, 1e-14);
  }



  TEST(Boundaries, CornerOfSeabedAndRoller)
  {
    // The roller holds what moves along the seabed, so that friction has
    // nothing to do.
    const OneNode<2> n("set Bottom = seabed\nset Left = roller",
                       law(0.5, 1e9),
                       Point<2>(0., 0.),
                       2.,
                       before,
                       trial);
    n.expect_velocity(Point<2>(0., 0.));
    n.expect_impulses(Point<2>(0., 1.), Point<2>(-6., 0.));
    EXPECT_EQ(n.friction_work(), 0.);
    EXPECT_NEAR(n.contact_work(), 6. * 0.5 + 1. * 0.1, 1e-14);
  }



  /// In the corner of a roller and a seabed, each has what it did itself, and
  /// together they have all.
  TEST(Boundaries, EachFaceKnowsItsForce)
  {
    OneNode<2> n("set Write forces = true\nset Left = roller\n" + bottom,
                 law(0.5, 1e9),
                 Point<2>(0., 0.),
                 2.,
                 before,
                 trial);
    n.boundaries.reactions().finish_step(MPI_COMM_SELF);
    Quantities row;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const StepReaction<2> &last = n.boundaries.reactions().all()[k].last;
        ReactionInterval<2>    interval;
        interval.add(last, dt, 0.);
        interval.list_quantities(n.boundaries.reactions().name(k), last, row);
      }
    const auto value = [&](const std::string &name) {
      for (const Quantity &quantity : row)
        if (quantity.name == name)
          return quantity.value;
      ADD_FAILURE() << name;
      return 0.;
    };
    // The roller stops 3 m/s, the seabed 0.5 m/s, of 2 kg; without motion along
    // the face there is no friction left.
    EXPECT_DOUBLE_EQ(value("Left impulse x"), 6.);
    EXPECT_DOUBLE_EQ(value("Left force x"), 60.);
    EXPECT_DOUBLE_EQ(value("Left impulse y"), 0.);
    EXPECT_DOUBLE_EQ(value("Bottom impulse y"), -1.);
    EXPECT_DOUBLE_EQ(value("Bottom impulse x"), 0.);
    EXPECT_DOUBLE_EQ(value("Bottom contact area"), 0.5);
    EXPECT_NEAR(value("Left contact work") + value("Bottom contact work"),
                n.contact_work(),
                1e-14);
  }



  /// What forces and boundaries do is the change of the kinetic energy.
  TEST(Boundaries, WorkClosesTheBudget)
  {
    for (const std::string conditions :
         {"set Bottom = seabed\nset Left = roller",
          "set Bottom = seabed\nset Left = seabed",
          "set Bottom = roller\nset Left = fixed",
          "set Bottom = seabed",
          "set Bottom = seabed\nset Left = velocity\n"
          "set Left velocity = -1.5; free",
          "set Bottom = velocity\nset Bottom velocity = free; 0.3\n"
          "set Left = roller",
          "set Bottom = seabed\nset Left = traction\n"
          "set Left traction = 7; 5",
          "set Bottom = velocity\nset Bottom velocity = 1; free\n"
          "set Left = traction\nset Left traction = 7; 5"})
      for (const double mu : {0.1, 0.5, 100.})
        {
          const OneNode<2> n(conditions,
                             law(mu, 40.),
                             Point<2>(0., 0.),
                             2.,
                             before,
                             Point<2>(-3., -0.5));
          EXPECT_NEAR(n.nodes.kinetic_energy() - n.kinetic_energy_before,
                      n.force_work - n.friction_work() - n.contact_work(),
                      1e-13)
            << conditions << mu;
        }
  }



  /// Nodes inside, and on other faces, are left alone; so are light ones.
  TEST(Boundaries, OnlyNodesOnTheFaceWithMass)
  {
    for (const Point<2> place : {Point<2>(2., 1.), Point<2>(4., 4.)})
      OneNode<2>(
        "set Bottom = fixed\nset Left = roller", "", place, 2., before, trial)
        .expect_velocity(trial);
    OneNode<2> n("", "", on_bottom, 2., before, trial);
    dealii::ParameterAcceptor::prm.parse_input_from_string(
      in_section("Boundaries", "set Bottom = fixed"));
    dealii::ParameterAcceptor::parse_all_parameters();
    n.boundaries.parse(Constants());
    n.constants.mass_cutoff = 2.1;
    n.boundaries.correct_velocities(n);
    n.expect_velocity(trial);
    n.constants.mass_cutoff = 1.9;
    n.boundaries.correct_velocities(n);
    n.expect_velocity(Point<2>());
  }



  /// Conditions by expression on the bottom, and whatever else.
  std::string
  by_expression(const std::string &condition,
                const std::string &expressions,
                const std::string &others = "")
  {
    return "set Bottom = " + condition + "\nset Bottom " + condition + " = " +
           expressions + "\n" + others;
  }



  TEST(Boundaries, VelocityAtThePlaceAndHalfStep)
  {
    const OneNode<2> n(by_expression("velocity", "x + 10*t; free"),
                       "",
                       on_bottom,
                       2.,
                       before,
                       trial);
    n.expect_velocity(Point<2>(2. + 10. * 0.5 * dt, -0.5));
    n.expect_impulses(Point<2>(), Point<2>(2. * (2.5 - 3.), 0.));
    // It brakes: mean velocity over the step (1 + 2.5)/2.
    EXPECT_NEAR(n.contact_work(), 1. * 1.75, 1e-14);
    const OneNode<3> m("set Front = velocity\nset Front velocity = z; x; y",
                       "",
                       Point<3>(2., 3., 4.),
                       2.,
                       Tensor<1, 3>(),
                       Tensor<1, 3>());
    m.expect_velocity(Point<3>(4., 2., 3.));
  }



  TEST(Boundaries, CornersWithVelocity)
  {
    const std::string left = "set Left = velocity\nset Left velocity = ";
    const auto expect = [](const std::string &conditions, const Point<2> &v) {
      OneNode<2>(conditions, law(0.5, 1e9), Point<2>(0., 0.), 2., before, trial)
        .expect_velocity(v);
    };
    // What both prescribe is that of the face whose normal it is.
    expect(by_expression("velocity", "1; 2", left + "3; 4"), {3., 2.});
    expect(by_expression("velocity", "1; free", left + "free; 4"), {1., 4.});
    expect(by_expression("velocity", "free; 2", left + "free; 4"), {3., 2.});
    expect(by_expression("velocity", "1; 2", "set Left = roller"), {0., 2.});
    expect(by_expression("velocity", "1; 2", "set Left = fixed"), {0., 0.});
    // Friction, 5 N, does not brake what is prescribed.
    expect("set Bottom = seabed\n" + left + "1; free", {1., 0.});
  }



  TEST(Boundaries, TractionOnTheAreaThatSoilFills)
  {
    const std::string traction = by_expression("traction", "3; -4*x");
    const OneNode<2>  n(traction, "", on_bottom, 2., before, trial);
    n.expect_velocity(trial + Point<2>(3., -8.) * dt / 2.);
    n.expect_impulses(Point<2>(), Point<2>(0.3, -0.8));
    EXPECT_NEAR(n.contact_work(),
                -0.3 * 0.5 * (1. + 3.15) - 0.8 * 0.5 * (0.2 + 0.9),
                1e-14);
    OneNode<2>(traction, "", on_bottom, 2., before, trial, 0.25)
      .expect_velocity(trial + Point<2>(3., -8.) * dt / 4.);
  }



  TEST(Boundaries, ExpressionsThatDoNotFit)
  {
    const auto error = [](const std::string &conditions) {
      return message_of<ExcUser>([&]() {
        Core<2> core(cube<2>() + in_section("Boundaries", conditions));
        core.boundaries.parse(Constants());
      });
    };
    EXPECT_EQ(error("set Top = velocity\nset Top velocity = free; -t"), "");
    for (const auto &[conditions, words] :
         std::map<std::string, std::vector<std::string>>{
           {"set Top = velocity",
            {"'Boundaries/Top' is 'velocity'", "'Boundaries/Top velocity' is"}},
           {"set Top velocity = 1; 2",
            {"'Boundaries/Top velocity = 1; 2'", "is 'free'", "remove"}},
           {"set Top = velocity\nset Top traction = 1; 2",
            {"'Boundaries/Top velocity' is empty"}},
           {"set Top = traction\nset Top traction = free; 2",
            {"'Boundaries/Top traction = free; 2'", "0 for a component"}},
           {"set Top = velocity\nset Top velocity = free",
            {"'Boundaries/Top velocity'", "2 are needed"}},
           {"set Top = velocity\nset Top velocity = free; q",
            {"'Boundaries/Top velocity'", "cannot be understood"}}})
      for (const std::string &word : words)
        EXPECT_TRUE(contains(error(conditions), word)) << error(conditions);
  }
} // namespace
