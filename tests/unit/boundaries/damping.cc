// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/damping.h>
#include <talus/contact/contact.h>

#include "ranks_setup.h"

namespace
{
  constexpr double step_length = 0.1;

  /// All nodes of a mesh of cells of 1 m, and local damping.
  struct Damped : Core<2>
  {
    Damped(const double alpha, const std::string &conditions = "")
      : Core<2>(cube<2>() +
                in_section("Boundaries",
                           conditions + "\n" +
                             in_section("Seabed", "set Gap = false")))
    {
      auto &prm = dealii::ParameterAcceptor::prm;
      dealii::ParameterAcceptor::declare_all_parameters();
      prm.parse_input_from_string(
        in_section("Damping", text("set Local damping = ", alpha)));
      dealii::ParameterAcceptor::parse_all_parameters();
      boundaries.parse(Constants());
      boundaries.prepare(grid);
      contact.prepare(grid);
      contact.open_accounts(accounts);
      time_step = step_length;
      std::vector<unsigned int> all(grid.cells().size());
      for (unsigned int c = 0; c < all.size(); ++c)
        all[c] = c;
      nodes.activate(grid, all);
      nodes.clear();
    }

    void
    set_node(const unsigned int node,
             const double       mass,
             const Vector      &velocity,
             const Vector      &force)
    {
      nodes.set_sums(node, mass, 0., mass * velocity, force);
    }

    double
    apply()
    {
      nodes.update_momentum(step_length, 0.);
      return damping.apply(nodes, grid, 0.);
    }

    /// Apply contact and walls, and record their works.
    void
    apply_boundaries()
    {
      contact.find_soil(*this);
      contact.correct_velocities(*this);
      boundaries.correct_velocities(*this);
      contact.record(*this);
    }

    Obstacles<2>                     obstacles{{}};
    Contact<2>                       contact{obstacles, boundaries};
    const std::vector<unsigned char> feels_obstacle;
    Damping<2>                       damping{boundaries, feels_obstacle};
  };



  /// Velocity of a node of 2 kg that moved with @p v (m/s) and is under @p f
  /// (N) along x, with alpha = 0.5, and the work taken.
  std::pair<double, double>
  damped(const double v, const double f)
  {
    Damped scene(0.5);
    scene.set_node(7, 2., Point<2>(v, 0.), Point<2>(f, 0.));
    const double work = scene.apply();
    EXPECT_EQ(scene.nodes.velocity(7)[1], 0.);
    return {scene.nodes.velocity(7)[0], work};
  }



  TEST(Damping, ShareOfTheForceAgainstTheMotion)
  {
    const auto expect = [](const double v,
                           const double f,
                           const double v_new,
                           const double work) {
      const auto [velocity, taken] = damped(v, f);
      EXPECT_NEAR(velocity, v_new, 1e-15);
      EXPECT_NEAR(taken, work, 1e-15);
    };
    // dt f/m = 0.2 m/s, of which damping takes half.
    expect(0., 4., 0.1, 0.2 * 0.05);
    expect(1., 4., 1.1, 0.2 * 1.05);
    expect(1., -4., 0.7, 0.2 * 0.85);
    expect(-1., 4., -0.7, 0.2 * 0.85);
    // The force turns the motion around: at most the mean is stopped, here
    // from 0.08 and -0.12 (mean -0.02).
    expect(0.08, -4., -0.08, 0.);
    // In equilibrium there is none.
    expect(1., 0., 1., 0.);
  }



  TEST(Damping, TakesEnergyOnlyAndTheBudgetCloses)
  {
    for (const double alpha : {0., 0.3, 0.99})
      {
        Damped scene(alpha,
                     "set Bottom = seabed\nset Left = roller\n"
                     "set Top = velocity\nset Top velocity = 1; free\n"
                     "set Right = traction\nset Right traction = 3; -1");
        auto  &nodes = scene.nodes;
        for (const unsigned int node : nodes.active_nodes())
          scene.set_node(node,
                         scene.number(1., 2.),
                         scene.vector(-1., 1.),
                         scene.vector(-40., 40.));
        std::vector<Tensor<1, 2>> force;
        double                    before = 0;
        for (const unsigned int node : nodes.active_nodes())
          {
            const auto v = nodes.momentum(node) / nodes.mass(node);
            force.push_back(nodes.force(node));
            before += 0.5 * nodes.mass(node) * v.norm_square();
          }
        scene.boundaries.add_tractions(nodes, scene.grid, 0., 0.);
        const double taken = scene.apply();
        scene.apply_boundaries();
        double of_forces = 0;
        for (unsigned int i = 0; i < force.size(); ++i)
          of_forces += step_length * force[i] *
                       nodes.mean_velocity(nodes.active_nodes()[i]);
        EXPECT_EQ(taken > 0, alpha > 0);
        EXPECT_NEAR(nodes.kinetic_energy() - before,
                    of_forces - taken - scene.accounts.energy("contact work") -
                      scene.accounts.energy("friction work"),
                    1e-12);
      }
  }



  // The reaction of a wall is no unbalanced force: damping must not bear it.
  TEST(Damping, LeavesToTheBoundariesWhatTheyHold)
  {
    const auto wall_impulse = [](const double alpha) {
      Damped scene(alpha,
                   "set Bottom = roller\nset Left = seabed\n"
                   "set Top = velocity\nset Top velocity = 1; free");
      for (const unsigned int node : scene.nodes.active_nodes())
        scene.set_node(node,
                       1.,
                       scene.vector(-1., 1.),
                       scene.vector(-40., 40.));
      scene.apply();
      scene.apply_boundaries();
      return std::make_pair(scene.accounts.impulse("wall impulse"),
                            scene.accounts.impulse("seabed impulse"));
    };
    EXPECT_EQ(wall_impulse(0.), wall_impulse(0.9));
  }



  template <int dim>
  void
  expect_places(const std::string &velocity, const Tensor<2, dim> &matrix)
  {
    std::string conditions;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      conditions += "set " + face_names[face] + " = velocity\nset " +
                    face_names[face] + " velocity = " + velocity + "\n";
    for (unsigned int kind = 0; kind < n_kinds_of_mesh; ++kind)
      {
        Core<dim> core(slab<dim>() + in_section("Boundaries", conditions));
        make_mesh(core, kind, 1);
        auto &grid  = core.grid;
        auto &nodes = core.nodes;
        core.boundaries.parse(Constants());
        core.boundaries.prepare(grid);
        std::vector<unsigned int> all(grid.n_owned_cells());
        for (unsigned int c = 0; c < all.size(); ++c)
          all[c] = c;
        nodes.activate(grid, all);
        for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
          nodes.set_sums(node, 1., 0., Tensor<1, dim>(), Tensor<1, dim>());
        core.time_step = step_length;
        core.boundaries.open_accounts(core.accounts);
        core.boundaries.correct_velocities(core);
        for (const auto &cell : grid.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              {
                const auto dof = cell->vertex_dof_index(v, 0);
                if (!grid.owned_nodes().is_element(dof))
                  continue;
                const unsigned int node =
                  grid.owned_nodes().index_within_set(dof);
                if (grid.faces_of_node(node) != 0)
                  {
                    EXPECT_LT(
                      (nodes.velocity(node) - matrix * cell->vertex(v)).norm(),
                      1e-13);
                  }
              }
      }
  }



  TEST(Ranks, PrescribedVelocitiesKnowTheirPlaces)
  {
    Tensor<2, 2> turn;
    turn[0][1] = -1.;
    turn[1][0] = 1.;
    expect_places<2>("-y; x", turn);
    Tensor<2, 3> cycle;
    cycle[0][2] = cycle[1][0] = cycle[2][1] = 1.;
    expect_places<3>("z; x; y", cycle);
  }
} // namespace
