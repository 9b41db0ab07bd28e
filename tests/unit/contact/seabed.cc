// SPDX-License-Identifier: LGPL-2.1-or-later
#include "one_node_setup.h"

namespace
{
  TEST(Seabed, Stick)
  {
    // mu N = 70 N.
    const OneNode<2> n(bottom, law(7., 1e9), on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(0., 0.));
    n.expect_impulses(Point<2>(-6., 1.), Point<2>());
    // Mean velocities over the step: 1/2 and -0.1.
    EXPECT_NEAR(n.friction_work(), 6. * 0.5, 1e-14);
    EXPECT_NEAR(n.contact_work(), 1. * 0.1, 1e-14);
  }



  TEST(Seabed, CoulombSlip)
  {
    // mu N = 5 N: -0.25 m/s in a step.
    const OneNode<2> n(bottom, law(0.5, 1e9), on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(2.75, 0.));
    n.expect_impulses(Point<2>(-0.5, 1.), Point<2>());
    EXPECT_NEAR(n.friction_work(), 0.5 * 0.5 * (1. + 2.75), 1e-14);
    EXPECT_NEAR(n.contact_work(), 1. * 0.1, 1e-14);
  }



  TEST(Seabed, CappedSlip)
  {
    // tau A = 3 Pa 1 m (per m): -0.15 m/s in a step.
    const OneNode<2> n(bottom, law(0.5, 3.), on_bottom, 2., before, trial);
    n.expect_velocity(Point<2>(2.85, 0.));
    n.expect_impulses(Point<2>(-0.3, 1.), Point<2>());
    EXPECT_NEAR(n.friction_work(), 0.3 * 0.5 * (1. + 2.85), 1e-14);
  }



  TEST(Seabed, CapCountsTheAreaInContact)
  {
    // The node stands for 1 m of the face and 0.5 m^2 of the cells at it. Of a
    // box of 0.7 m around it, it gets 0.7 (1 - 0.35/2) m.
    const auto slows = [](const double                              volume,
                          const std::vector<std::array<double, 3>> &boxes,
                          const double                              area) {
      const OneNode<2> n(
        bottom, law(0.5, 3.), on_bottom, 2., before, trial, volume, boxes);
      n.expect_velocity(Point<2>(3. - area * 0.15, 0.));
    };
    slows(0.2, {{{2., 0.7, 0.}}}, 0.7 * (1. - 0.35 / 2.));
    // Boxes that overlap cover no more than there is.
    slows(0.2, {{{2., 2., 0.}}, {{2., 2., 0.}}}, 1.);
    // Soil that touches the node beside the boxes keeps 0.02 of 0.4.
    slows(0.2, {}, 0.008);
    // Where cells are full all of the face counts.
    slows(0.5, {{{2., 0.2, 0.}}}, 1.);
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
        EXPECT_EQ(n.friction_work(), 0.);
        EXPECT_EQ(n.contact_work(), 0.);
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
    const auto area = [&]() {
      return n.contact.slip().slipped_areas(1, MPI_COMM_SELF)[0];
    };
    const auto slip = [&]() {
      return n.contact.slip().largest_slips(1, MPI_COMM_SELF)[0];
    };
    EXPECT_EQ(area(), 0.);
    const double before_slip = n.friction_work();
    for (const double end : {0.03, 0.1, 0.4})
      {
        while (slip() < end)
          {
            n.set_node(m, 1e3, moves(v), Point<2>());
            n.step();
          }
        const double s        = slip();
        const double expected = r * tau * s + (1. - r) * tau * s_95 / 3. *
                                                (1. - std::exp(-3. * s / s_95));
        EXPECT_NEAR(n.friction_work() - before_slip, expected, 1e-3 * expected)
          << s;
        EXPECT_EQ(area(), 1.);
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
    EXPECT_NEAR(n.friction_work(), 0.5 * 0.5 * 4.75, 1e-14);
  }



  /// A node that moves away in a step still has the friction of the mean normal
  /// force, which fades by the slip of the step, and is forgotten in a step
  /// without soil.
  TEST(Seabed, FrictionFollowsTheMeanNormalForce)
  {
    OneNode<2> n(bottom, law(0.5, 1e9), on_bottom, 2., before, trial);
    // N = 10 N in the first step. A slip of 1 mm counts 1/32 + 0.001/0.05.
    const auto move_away = [&](const double expected) {
      n.set_node(2., 1e3, Point<2>(0.01, 0.2), Point<2>());
      n.step();
      n.expect_velocity(Point<2>(expected, 0.2));
    };
    // The friction would stop 1.5 N s, so it stops the node.
    move_away(0.);
    n.set_node(0., 0., Point<2>(), Point<2>());
    n.step();
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
    // Contact begins a twentieth of a cell above the face.
    for (const double gap : {0., 0.02, 1.})
      {
        const OneNode<2> n(bottom,
                           "set Gap = true",
                           on_bottom,
                           2.,
                           before,
                           trial,
                           1.,
                           {{{2., 0.5, gap + 0.05}}});
        // 0.5 m/s would take it 0.05 m.
        EXPECT_NEAR(n.nodes.velocity(n.node)[1],
                    std::max(trial[1], -gap / dt),
                    1e-14);
      }
  }
} // namespace
