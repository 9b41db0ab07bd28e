// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/reaction_interval.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double dt = 0.1;

  /// One node of a mesh of cells of 1 m with a mass and a trial velocity.
  template <int dim>
  struct OneNode : Core<dim>
  {
    OneNode(const std::string    &conditions,
            const std::string    &seabed,
            const Point<dim>     &place,
            const double          mass,
            const Tensor<1, dim> &before,
            const Tensor<1, dim> &trial,
            const double          volume       = 1e3,
            const double          covered_area = 0.)
      : Core<dim>(cube<dim>() +
                  in_section("Boundaries",
                             conditions + "\n" + in_section("Seabed", seabed)))
    {
      const auto places = places_of_nodes(this->grid);
      node              = 0;
      while (places[node].distance(place) > 1e-12)
        ++node;
      std::vector<unsigned int> all(this->grid.cells().size());
      for (unsigned int c = 0; c < all.size(); ++c)
        all[c] = c;
      auto &nodes = this->nodes;
      nodes.activate(this->grid, all);
      nodes.clear();
      nodes.set_sums(
        node, mass, volume, mass * before, mass * (trial - before) / dt);
      this->boundaries.parse(Constants());
      this->boundaries.prepare(this->grid);
      this->boundaries.set_covered_area(
        [=](const unsigned int, const unsigned int) { return covered_area; });
      this->boundaries.set_gap(
        [](const unsigned int, const unsigned int) { return 0.; });
      this->boundaries.add_tractions(nodes, this->grid, 0., 0.);
      nodes.update_momentum(dt, 0.);
      kinetic_energy_before = 0.5 * mass * before.norm_square();
      work = this->boundaries.apply(nodes, this->grid, 0., dt, 0.);
      // Work is taken with the mean of the velocities before and after.
      force_work = mass * (trial - before) * nodes.mean_velocity(node);
    }

    void
    expect_velocity(const Tensor<1, dim> &v) const
    {
      EXPECT_LT((this->nodes.velocity(node) - v).norm(), 1e-14)
        << this->nodes.velocity(node);
    }

    void
    expect_impulses(const Tensor<1, dim> &seabed,
                    const Tensor<1, dim> &wall) const
    {
      EXPECT_LT((work.seabed_impulse - seabed).norm(), 1e-13)
        << work.seabed_impulse;
      EXPECT_LT((work.wall_impulse - wall).norm(), 1e-13) << work.wall_impulse;
    }

    unsigned int      node;
    double            kinetic_energy_before, force_work;
    BoundaryWork<dim> work;
  };

  const std::string bottom = "set Bottom = seabed";
  const Point<2>    on_bottom(2., 0.);



  /// Law with a friction coefficient and a cap, Pa.
  std::string
  law(const double mu, const double cap)
  {
    return text(
      "set Friction coefficient = ", mu, "\nset Maximum shear stress = ", cap);
  }



  // Mass 2 kg, before (1, -0.2), trial (3, -0.5) m/s: N = 2 0.5/0.1 = 10 N,
  // and 60 N would stop it.
  const Tensor<1, 2> before = Point<2>(1., -0.2), trial = Point<2>(3., -0.5);



  TEST(Seabed, Stick)
  {
    // mu N = 70 N.
    const OneNode<2> n(bottom, law(7., 1e9), on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(0., 0.));
    n.expect_impulses(Point<2>(-6., 1.), Point<2>());
    // Mean velocities over the step: 1/2 and -0.1.
    EXPECT_NEAR(n.work.friction, 6. * 0.5, 1e-14);
    EXPECT_NEAR(n.work.contact, 1. * 0.1, 1e-14);
  }



  TEST(Seabed, CoulombSlip)
  {
    // mu N = 5 N: -0.25 m/s in a step.
    const OneNode<2> n(bottom, law(0.5, 1e9), on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(2.75, 0.));
    n.expect_impulses(Point<2>(-0.5, 1.), Point<2>());
    EXPECT_NEAR(n.work.friction, 0.5 * 0.5 * (1. + 2.75), 1e-14);
    EXPECT_NEAR(n.work.contact, 1. * 0.1, 1e-14);
  }



  TEST(Seabed, CappedSlip)
  {
    // tau A = 3 Pa 1 m (per m): -0.15 m/s in a step.
    const OneNode<2> n(bottom, law(0.5, 3.), on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(2.85, 0.));
    n.expect_impulses(Point<2>(-0.3, 1.), Point<2>());
    EXPECT_NEAR(n.work.friction, 0.3 * 0.5 * (1. + 2.85), 1e-14);
  }



  TEST(Seabed, CapCountsTheAreaInContact)
  {
    // The node stands for 1 m of the face and 0.5 m^2 of the cells at it; soil
    // that fills two fifths of them covers 0.7 m.
    const OneNode<2> thin(
      bottom, law(0.5, 3.), on_bottom, 2., before, trial, 0.2, 0.7);
    thin.expect_velocity(Point<2>(3. - 0.7 * 0.15, 0.));
    // Boxes that overlap cover no more than there is.
    const OneNode<2> double_row(
      bottom, law(0.5, 3.), on_bottom, 2., before, trial, 0.2, 1.7);
    double_row.expect_velocity(Point<2>(2.85, 0.));
    // Soil that touches the node beside the boxes keeps 0.02 of 0.4.
    const OneNode<2> beside(
      bottom, law(0.5, 3.), on_bottom, 2., before, trial, 0.2, 0.);
    beside.expect_velocity(Point<2>(3. - 0.008 * 0.15, 0.));
    // Where cells are full all of the face counts.
    const OneNode<2> full(
      bottom, law(0.5, 3.), on_bottom, 2., before, trial, 0.5, 0.2);
    full.expect_velocity(Point<2>(2.85, 0.));
    // At the end of the face it is half of both.
    const OneNode<2> end(
      bottom, law(0.5, 3.), Point<2>(0., 0.), 2., before, trial, 0.25);
    end.expect_velocity(Point<2>(3. - 0.075, 0.));
  }



  TEST(Seabed, SeparationIsFree)
  {
    for (const double v_n : {0.5, 0.})
      {
        const Point<2>   away(3., v_n);
        const OneNode<2> n(bottom, law(7., 1e9), on_bottom, 2., before, away);
        n.expect_velocity(away);
        n.expect_impulses(Point<2>(), Point<2>());
        EXPECT_EQ(n.work.friction, 0.);
        EXPECT_EQ(n.work.contact, 0.);
      }
  }



  // A heavy node is dragged over the seabed: friction takes
  //   r tau_p s + (1 - r) tau_p s_95/3 (1 - e^(-3 s/s_95))
  // per area. Before, it sticks, which is no slip.
  TEST(Seabed, WorkOfSofteningBySlip)
  {
    constexpr double tau = 3500., r = 0.4, s_95 = 0.1, m = 1e12, v = 2e-4;
    const auto moves = [](const double speed) { return Point<2>(speed, -1.); };
    OneNode<2> n(bottom,
                 law(10., tau) + text("\nset Slip to remould = ",
                                      s_95,
                                      "\nset Remoulded shear stress ratio = ",
                                      r),
                 on_bottom,
                 m,
                 Point<2>(),
                 moves(1e-12));
    const BedSlip<2> &slip = n.boundaries.seabed().slip();
    EXPECT_EQ(slip.slipped_area(), 0.);
    double work = 0.;
    for (const double end : {0.03, 0.1, 0.4})
      {
        while (slip.largest_slip() < end)
          {
            n.nodes.clear();
            n.nodes.set_sums(n.node, m, 1e3, m * moves(v), Point<2>());
            n.nodes.update_momentum(dt, 0.);
            work += n.boundaries.apply(n.nodes, n.grid, 0., dt, 0.).friction;
          }
        const double s        = slip.largest_slip();
        const double expected = r * tau * s + (1. - r) * tau * s_95 / 3. *
                                                (1. - std::exp(-3. * s / s_95));
        EXPECT_NEAR(work, expected, 1e-3 * expected) << s;
        EXPECT_EQ(slip.slipped_area(), 1.);
      }
  }



  /// The face looks the other way; friction acts against both tangents.
  TEST(Seabed, UpperFaceIn3D)
  {
    const OneNode<3> n("set Front = seabed",
                       law(0.5, 1e9),
                       Point<3>(2., 2., 4.),
                       2.,
                       Tensor<1, 3>(),
                       Point<3>(3., -4., 0.5));
    // 5 N against 5 m/s: 0.25 m/s less.
    n.expect_velocity(Point<3>(3. * 0.95, -4. * 0.95, 0.));
    n.expect_impulses(Point<3>(-0.3, 0.4, -1.), Point<3>());
    // Without load at rest before, means are half of the new velocity.
    EXPECT_NEAR(n.work.friction, 0.5 * 0.5 * 4.75, 1e-14);
  }



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
        EXPECT_EQ(n.work.friction, 0.);
        EXPECT_NEAR(n.work.contact, 2. * v_n * 0.5 * -0.2, 1e-14);
      }
  }



  TEST(Boundaries, FixedHoldsAll)
  {
    const OneNode<2> n("set Bottom = fixed", "", on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(0., 0.));
    n.expect_impulses(Point<2>(), -2. * trial);
    EXPECT_NEAR(n.work.contact, 2. * trial * (0.5 * before), 1e-14);
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
    EXPECT_EQ(n.work.friction, 0.);
    EXPECT_NEAR(n.work.contact, 6. * 0.5 + 1. * 0.1, 1e-14);
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
                n.work.contact,
                1e-14);
  }



  /// A node that moves away in a step still has the friction of the mean normal
  /// force, which fades by the slip of the step, and is forgotten in a step
  /// without soil.
  TEST(Seabed, FrictionFollowsTheMeanNormalForce)
  {
    OneNode<2> n(bottom, law(0.5, 1e9), on_bottom, 2., before, trial);
    // N = 10 N in the first step. A slip of 1 mm counts 1/32 + 0.001/0.05.
    const auto move_away = [&](const double expected) {
      n.nodes.clear();
      const Tensor<1, 2> v = Point<2>(0.01, 0.2);
      n.nodes.set_sums(n.node, 2., 1e3, 2. * v, Tensor<1, 2>());
      n.nodes.update_momentum(dt, 0.);
      n.boundaries.apply(n.nodes, n.grid, 0., dt, 0.);
      n.expect_velocity(Point<2>(expected, 0.2));
    };
    // The friction would stop 1.5 N s, so it stops the node.
    move_away(0.);
    n.nodes.clear();
    n.boundaries.apply(n.nodes, n.grid, 0., dt, 0.);
    move_away(0.01);
  }



  /// The film brakes what friction leaves: for n = 1,
  /// (m + dt A K/b) v = m v_trial - dt tau A.
  TEST(Seabed, FilmIsImplicit)
  {
    const std::string film =
      "\nset Film consistency = 30\nset Film thickness = 0.5";
    const OneNode<2> n(
      bottom, law(0.5, 3.) + film, on_bottom, 2., before, trial);
    n.expect_velocity(
      Point<2>((2. * 3. - 0.1 * 3.) / (2. + 0.1 * 30. / 0.5), 0.));
    // With n = 1/2 the root of 2 v + 0.1 30 sqrt(v/0.5) = 5.7.
    const OneNode<2> thinning(bottom,
                              law(0.5, 3.) + film + "\nset Film exponent = 0.5",
                              on_bottom,
                              2.,
                              before,
                              trial);
    const double     v = thinning.nodes.velocity(thinning.node)[0];
    EXPECT_NEAR(2. * v + 3. * std::sqrt(v / 0.5), 5.7, 1e-12);
  }



  /// Soil that has not come to the seabed by more than the gap is let fall to
  /// it.
  TEST(Seabed, GapLeavesRoomToFall)
  {
    Core<2> core(
      cube<2>() +
      in_section("Boundaries",
                 bottom + "\n" + in_section("Seabed", "set Gap = true")));
    for (const double gap : {0., 0.02, 1.})
      {
        auto                     &nodes = core.nodes;
        std::vector<unsigned int> all(core.grid.cells().size());
        for (unsigned int c = 0; c < all.size(); ++c)
          all[c] = c;
        nodes.activate(core.grid, all);
        nodes.clear();
        unsigned int node = 0;
        while (places_of_nodes(core.grid)[node].distance(on_bottom) > 1e-12)
          ++node;
        nodes.set_sums(node, 2., 1., 2. * before, 2. * (trial - before) / dt);
        core.boundaries.parse(Constants());
        core.boundaries.prepare(core.grid);
        core.boundaries.set_gap(
          [=](const unsigned int, const unsigned int) { return gap; });
        nodes.update_momentum(dt, 0.);
        core.boundaries.apply(nodes, core.grid, 0., dt, 0.);
        // 0.5 m/s would take it 0.05 m.
        EXPECT_NEAR(nodes.velocity(node)[1],
                    std::max(trial[1], -gap / dt),
                    1e-14);
      }
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
                      n.force_work - n.work.friction - n.work.contact,
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
    n.boundaries.apply(n.nodes, n.grid, 0., dt, 2.1);
    n.expect_velocity(trial);
    n.boundaries.apply(n.nodes, n.grid, 0., dt, 1.9);
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
    EXPECT_NEAR(n.work.contact, 1. * 1.75, 1e-14);
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
    EXPECT_NEAR(n.work.contact,
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
