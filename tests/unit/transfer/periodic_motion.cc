// SPDX-License-Identifier: LGPL-2.1-or-later
// Motion across the faces of meshes that repeat. The suite works on any number
// of ranks; ctest runs it on 1, 2 and 3.
#include "periodic_setup.h"
#include "specimen.h"

namespace
{
  /// Where a step of a random walk takes the point, along periodic axes.
  template <int dim>
  Tensor<1, dim>
  stride(Core<dim>           &core,
         const Periodic<dim> &periodic,
         const unsigned int   p,
         const unsigned int   step)
  {
    core.random.seed(1000 * step + core.points.data(core.points.id)[p]);
    Tensor<1, dim> by = core.vector(-0.5, 0.99);
    for (unsigned int d = 0; d < dim; ++d)
      by[d] *= periodic.axes[d];
    return by;
  }



  /// Everybody arrives, nobody is lost, and the displacement of a point is what
  /// it walked.
  template <int dim>
  void
  expect_walkers_arrive(const Periodic<dim> &periodic)
  {
    constexpr unsigned int n_steps = 40;
    Core<dim>              core(periodic.grid() + periodic.conditions());
    scramble(core, 5);
    add_repeated(core, periodic, 1, 0.);
    auto              &points = core.points;
    const unsigned int n      = MPI::sum(points.size(), MPI_COMM_WORLD);
    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        for (unsigned int p = 0; p < points.size(); ++p)
          core.set(points.position,
                   p,
                   core.get(points.position, p) +
                     stride(core, periodic, p, step));
        core.sort();
        expect_sorted(core);
        EXPECT_EQ(MPI::sum(points.size(), MPI_COMM_WORLD), n);
      }
    double farthest = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        Tensor<1, dim> walked;
        for (unsigned int step = 1; step <= n_steps; ++step)
          walked += stride(core, periodic, p, step);
        EXPECT_LT((core.get(points.position, p) -
                   core.get(points.initial_position, p) - walked)
                    .norm(),
                  1e-12);
        farthest = std::max(farthest, walked.norm());
      }
    EXPECT_GT(MPI::max(farthest, MPI_COMM_WORLD), 2. * periodic.width);
  }



  TEST(Periodic, WalkersArrive)
  {
    on_periodic_meshes(
      [](const auto &periodic) { expect_walkers_arrive(periodic); });
  }



  // Children beyond the seam are legal: the split changes no sum.
  TEST(Periodic, SplitsAcrossTheSeam)
  {
    for (const unsigned int width : {1, 2, 5})
      {
        const Periodic<2> periodic{{{true, false}}, width};
        Core<2>           core(
          periodic.grid() + periodic.conditions() +
          in_section("Splitting",
                     "set Shear = counted\n"
                               "set Minimum length = 0\nset Directions = all"));
        const Point<2> x(-2.999, -1.4);
        if (core.grid.find_cell(x) < core.grid.n_owned_cells())
          {
            const unsigned int p = core.add(x, Point<2>(0.5, 0.5));
            core.randomize(p);
            core.set_undeformed(p, Point<2>(0.5, 0.5));
            core.stretch(p, 0, 1.7);
          }
        core.sort();
        const auto before = sums_by_place(core);
        core.split();
        core.sort();
        EXPECT_EQ(MPI::sum(core.points.size(), MPI_COMM_WORLD), 4u);
        unsigned int n_across = 0;
        for (unsigned int p = 0; p < core.points.size(); ++p)
          n_across += (core.points.data(core.points.position)[p] >
                       core.grid.domain().upper[0] - 0.3);
        EXPECT_EQ(MPI::sum(n_across, MPI_COMM_WORLD), 2u);
        for (const auto &[place, sums] : sums_by_place(core))
          for (unsigned int i = 0; i < SumIndex<2>::n_entries; ++i)
            EXPECT_NEAR(sums[i], before.at(place)[i], 1e-12);
      }
  }



  // --------------------------------------------------------------- dynamics

  /// What an elastic blob in flight has done.
  template <int dim>
  struct Flight
  {
    double                                 kinetic_energy = 0; ///< J
    double                                 elastic_energy = 0; ///< J
    Tensor<1, dim>                         momentum;           ///< kg m/s
    std::map<unsigned int, Tensor<1, dim>> displacement;       ///< by id, m
  };



  template <int dim>
  Flight<dim>
  look_at(const Core<dim> &core)
  {
    const auto &points = core.points;
    Flight<dim> flight;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double         mass = points.data(points.mass)[p];
        const Tensor<1, dim> v    = core.get(points.velocity, p);
        flight.kinetic_energy += 0.5 * mass * v.norm_square();
        flight.elastic_energy += points.data(points.elastic_energy)[p];
        flight.momentum += mass * v;
        flight.displacement[points.data(points.id)[p]] =
          core.get(points.position, p) - core.get(points.initial_position, p);
      }
    const MPI_Comm communicator = core.grid.communicator();
    flight.kinetic_energy       = MPI::sum(flight.kinetic_energy, communicator);
    flight.elastic_energy       = MPI::sum(flight.elastic_energy, communicator);
    flight.momentum             = MPI::sum(flight.momentum, communicator);
    return flight;
  }



  /// Points of a blob with its lower corner at @p corner, two per cell and axis
  /// but shaken, in flight and trembling.
  template <int dim>
  void
  add_blob(Core<dim> &core, const Point<dim> &corner, const double density)
  {
    auto &points = core.points;
    for (unsigned int i = 0; i < power(5, dim); ++i)
      {
        core.random.seed(i + 1);
        Point<dim> x = corner + core.vector(-0.1, 0.1);
        for (unsigned int d = 0; d < dim; ++d)
          x[d] += 0.5 * (i / power(5, d) % 5) + 0.2;
        Tensor<1, dim> v = core.vector(-0.5, 0.5);
        for (unsigned int d = 0; d < dim; ++d)
          v[d] += 2. - 0.7 * d;
        if (core.grid.find_cell(x) >= core.grid.n_owned_cells())
          continue;
        Tensor<1, dim> length;
        for (unsigned int d = 0; d < dim; ++d)
          length[d] = 0.5;
        const unsigned int p        = core.add(x, length);
        points.data(points.mass)[p] = density * std::pow(0.5, dim);
        points.data(points.id)[p]   = i;
        core.set(points.velocity, p, v);
      }
  }



  /// Let it fly; momentum must not change in any step.
  template <int dim>
  Flight<dim>
  fly(Core<dim> &core, const Point<dim> &corner)
  {
    constexpr double dt  = 0.02;
    const auto       law = make_law<dim>(
      "neo-Hookean",
      "set Young's modulus = 1e3\nset Poisson's ratio = 0.3\nset Density = 10");
    auto &points = core.points;
    law->add_columns(points);
    core.transfer.use_bbar({true});
    add_blob(core, corner, law->density());
    law->initialize(points, 0, points.size());
    core.sort();
    const Flight<dim> start = look_at(core);
    for (unsigned int step = 0; step < 120; ++step)
      {
        core.scatter();
        core.nodes.update_momentum(dt, 0.);
        core.nodes.share_with_ghosts(core.grid);
        core.gather(dt);
        core.transfer.apply_bbar_to_dilatation(points,
                                               core.workspace,
                                               points.all());
        law->update_stress(points, core.workspace, 0, points.size(), dt);
        update_box_lengths(points,
                           0,
                           points.size(),
                           core.transfer.box_shape().rule);
        core.sort();
        EXPECT_LT((look_at(core).momentum - start.momentum).norm(),
                  1e-13 * start.momentum.norm());
      }
    return look_at(core);
  }



  /// The same blob in a wide mesh with faces and across the seams of a mesh
  /// that repeats: all that differs is round-off.
  template <int dim>
  void
  expect_same_flight(const unsigned int width)
  {
    Point<dim>        corner;
    const Flight<dim> expected = [&]() {
      const std::string upper = dim == 2 ? "17, 17" : "13, 13, 13";
      Core<dim>         wide(mesh(dim == 2 ? "-4, -7" : "-4, -5, -7", upper),
                     {},
                     MPI_COMM_SELF);
      return fly(wide, corner);
    }();
    EXPECT_GT(expected.displacement.at(0)[0], 3.);
    EXPECT_GT(expected.elastic_energy, 0.001 * expected.kinetic_energy);

    Periodic<dim> periodic;
    periodic.axes.fill(true);
    periodic.width = width;
    for (const int shift : {-3, -1, static_cast<int>(width) - 5})
      {
        SCOPED_TRACE(text(dim, "-D, from ", shift));
        Core<dim> core(periodic.grid() + periodic.conditions());
        scramble(core, 3);
        for (unsigned int d = 0; d < dim; ++d)
          corner[d] = shift;
        const Flight<dim> found = fly(core, corner);
        EXPECT_NEAR(found.kinetic_energy,
                    expected.kinetic_energy,
                    1e-12 * expected.kinetic_energy);
        EXPECT_NEAR(found.elastic_energy,
                    expected.elastic_energy,
                    1e-12 * expected.kinetic_energy);
        for (const auto &[id, displacement] : found.displacement)
          EXPECT_LT((displacement - expected.displacement.at(id)).norm(),
                    1e-11);
      }
  }



  TEST(Periodic, FlightAcrossTheSeam)
  {
    expect_same_flight<2>(8);
    expect_same_flight<3>(6);
  }
} // namespace
