// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/merger.h>
#include <talus/materials/materials.h>
#include <talus/transfer/box_rule.h>

#include <numeric>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  /// A Core whose points are merged.
  template <int dim>
  struct Merging : Core<dim>
  {
    explicit Merging(const std::string &parameters = "",
                     const std::string &of_merging = "")
      : Core<dim>(cube<dim>() + parameters)
    {
      this->points.add_pore_pressure();
      // The splitter's parameters, which share the section, stay.
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Splitting", "set Merge = all\n" + of_merging));
      dealii::ParameterAcceptor::parse_all_parameters();
    }

    /// Returns the kinetic energy lost, J.
    double
    merge(const std::vector<double> &added_mass = {})
    {
      return merger.merge(this->points,
                          this->grid,
                          this->transfer.box_shape().rule,
                          added_mass,
                          this->splitter);
    }

    Merger<dim> merger;
  };



  /// Two boxes in one cell, the second one shifted by @p offset; returns the
  /// number of points after.
  unsigned int
  count_after(
    const Point<2>     &length,
    const Point<2>     &offset,
    const std::string  &parameters = "",
    const unsigned int  body       = 0,
    const Tensor<2, 2> &F = Tensor<2, 2>(dealii::unit_symmetric_tensor<2>()))
  {
    Merging<2>     core(parameters);
    const Point<2> x(1.1, 1.1);
    core.add(x, length);
    const unsigned int q = core.add(x + offset, length, body);
    core.set_deformation(q, F);
    core.sort();
    core.merge();
    EXPECT_EQ(core.merger.n_merges(), 2u - core.points.size());
    EXPECT_EQ(core.points.n_sorted(), core.points.size());
    return core.points.size();
  }



  // --------------------------------------------------------------- criterion

  TEST(Merger, LengthIsLimitedAlongTheAxis)
  {
    const double most = 0.5; // of cells of 1 m
    for (const double side : {0.1, 0.4})
      {
        const double l = 0.5 * most, more = l * (1. + 1e-9);
        const double less = l * (1. - 1e-9);
        EXPECT_EQ(count_after({less, side}, {less, 0.}), 1u);
        EXPECT_EQ(count_after({more, side}, {more, 0.}), 2u);
        EXPECT_EQ(count_after({side, less}, {0., less}), 1u);
        EXPECT_EQ(count_after({side, more}, {0., more}), 2u);
      }
  }



  // Across, a box may be longer, but not so that it is split after a stretch by
  // less than a quarter: from a cell on, or from 0.7 of one with a threshold of
  // less than that.
  TEST(Merger, KeepsAwayFromThresholdsOfTheSplitter)
  {
    const auto count = [](const double side, const double threshold) {
      return count_after({0.1, side},
                         {0.1, 0.},
                         in_section("Splitting",
                                    text("set Threshold = ", threshold)));
    };
    EXPECT_EQ(count(0.8 - 1e-9, 1.4), 1u);
    EXPECT_EQ(count(0.8 + 1e-9, 1.4), 2u);
    EXPECT_EQ(count(0.56 - 1e-9, 1.2), 1u);
    EXPECT_EQ(count(0.56 + 1e-9, 1.2), 2u);
  }



  // Points may enter the smaller cells beside their own in the next step.
  TEST(Merger, LimitsAreInUnitsOfTheSmallestCellAround)
  {
    const auto count_at = [](const Point<2> &x) {
      Merging<2> core;
      refine_corner(core);
      for (const double y : {0., 0.15})
        core.add(x + Point<2>(0., y), Point<2>(0.6, 0.15));
      core.sort();
      core.merge();
      return core.points.size();
    };
    EXPECT_EQ(count_at({3.1, 3.1}), 1u) << "in cells of 1 m";
    EXPECT_EQ(count_at({2.1, 1.1}), 2u) << "beside cells of 0.5 m";
    EXPECT_EQ(count_at({0.1, 0.1}), 2u) << "in them";
  }



  // The misfits are: a shift s across boxes of side l gives
  // sqrt(1 + 3/4 s^2/l^2) - 1, a distance d instead of l gives sqrt(1/4 + 3/4
  // d^2/l^2) - 1.
  TEST(Merger, ToleranceIsExact)
  {
    const double l = 0.2, tolerance = 0.15;
    const auto   shift = [&](const double t) {
      return l * std::sqrt(((1. + t) * (1. + t) - 1.) * 4. / 3.);
    };
    const auto distance = [&](const double t) {
      return l * std::sqrt(((1. + t) * (1. + t) - 0.25) * 4. / 3.);
    };
    for (const double factor : {1. - 1e-9, 1. + 1e-9})
      {
        const unsigned int n = (factor < 1. ? 1 : 2);
        const double       t = factor * tolerance;
        EXPECT_EQ(count_after({l, l}, {l, shift(t)}), n);
        // (A box that was scaled to the same volume is no longer for a gap.)
        EXPECT_EQ(count_after({l, l}, {distance(t), 0.}), n);
        EXPECT_EQ(count_after({l, l}, {0., distance(-t)}), n);
      }
    const std::string exact = "set Merge tolerance = 0";
    for (const double s : {0., 1e-5})
      {
        Merging<2> core("", exact);
        core.add({1.1, 1.1}, Point<2>(l, l));
        core.add({1.1 + l, 1.1 + s}, Point<2>(l, l));
        core.sort();
        core.merge();
        EXPECT_EQ(core.points.size(), s == 0. ? 1u : 2u);
      }
  }



  TEST(Merger, BodiesAndCellsStayApart)
  {
    EXPECT_EQ(count_after({0.2, 0.2}, {0.2, 0.}), 1u);
    EXPECT_EQ(count_after({0.2, 0.2}, {0.2, 0.}, "", /*body=*/1), 2u);
    Merging<2> core;
    core.add({1.9, 1.5}, Point<2>(0.2, 0.2));
    core.add({2.1, 1.5}, Point<2>(0.2, 0.2));
    core.sort();
    core.merge();
    EXPECT_EQ(core.points.size(), 2u);
  }



  // A cell that is turned by a quarter does not fit beside the other.
  TEST(Merger, CellsTurnedAgainstEachOtherStayApart)
  {
    const Tensor<2, 2> F({{0., -1.}, {1., 0.}});
    EXPECT_EQ(count_after({0.1, 0.3}, {0.1, 0.}), 1u);
    EXPECT_EQ(count_after({0.1, 0.3}, {0.2, 0.}, "", 0, F), 2u);
  }



  // By default only points that come from a split are merged.
  TEST(Merger, PointsThatWereNeverSplitStay)
  {
    for (const double generation : {0., 1.})
      {
        Merging<2> core("", "set Merge = true");
        for (const double x : {1.1, 1.3})
          {
            const unsigned int p = core.add({x, 1.1}, Point<2>(0.2, 0.2));
            core.points.data(core.points.generation)[p] = generation;
          }
        core.sort();
        core.merge();
        EXPECT_EQ(core.points.size(), generation == 0. ? 2u : 1u);
      }
  }



  /// Two halves of a cell that is sheared by 0.55 and turned, cut along edge
  /// @p k; the second half has other edges of the same lattice.
  template <int dim>
  void
  expect_halves_fit(const unsigned int k, const bool other_basis)
  {
    Merging<dim>   core("", "set Merge tolerance = 0");
    auto          &points = core.points;
    Tensor<2, dim> F      = dealii::project_onto_orthogonal_tensors(
      core.tensor(-0.5, 0.5) +
      Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()));
    Tensor<2, dim> shear(dealii::unit_symmetric_tensor<dim>());
    shear[0][1] = 0.55;
    F           = F * shear;
    Tensor<1, dim> length;
    Point<dim>     x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 1.5, length[d] = (d == k ? 0.15 : 0.3);
    const Tensor<1, dim> edge = length[k] * transpose(F)[k];
    for (const double side : {-0.5, 0.5})
      core.set_deformation(core.add(x + side * edge, length), F);
    if (other_basis) // a_j + a_k in place of a_j
      for (unsigned int i = 0; i < dim; ++i)
        points.data(points.edges, dim * i + (k + 1) % dim)[1] += edge[i];
    core.sort();
    core.merge();
    ASSERT_EQ(points.size(), 1u);
    length[k] = 0.3;
    for (unsigned int j = 0; j < dim; ++j)
      EXPECT_LT(
        (edge_of_cell(points, j, 0) - length[j] * transpose(F)[j]).norm(),
        1e-12);
  }



  TEST(Merger, HalvesOfAShearedCell)
  {
    for (const bool other_basis : {false, true})
      {
        for (unsigned int k = 0; k < 2; ++k)
          expect_halves_fit<2>(k, other_basis);
        for (unsigned int k = 0; k < 3; ++k)
          expect_halves_fit<3>(k, other_basis);
      }
  }



  // The edges of a joint cell do not tell the deformation gradient, of which
  // the stress of a hyperelastic law is a function.
  TEST(Merger, PointsOfHyperelasticLawsStay)
  {
    Merging<2>   core;
    Materials<2> materials(
      {{"rubber", "neo-Hookean"}, {"clay", "linear elastic"}});
    using dealii::ParameterAcceptor;
    ParameterAcceptor::declare_all_parameters();
    for (const std::string name : {"rubber", "clay"})
      ParameterAcceptor::prm.parse_input_from_string(
        in_section("Materials",
                   in_section(name,
                              "set Young's modulus = 1e6\n"
                              "set Poisson's ratio = 0.3")));
    ParameterAcceptor::parse_all_parameters();
    materials.assign({"block", "soil"}, {"rubber", "clay"});
    materials.add_columns(core.points);
    core.constants.box_shape = core.transfer.box_shape();
    core.merger.prepare(core.splitter, core.constants.box_shape);
    core.merger.open_accounts(core.accounts);
    for (const unsigned int body : {0, 1})
      {
        for (const double x : {1.1, 1.3})
          core.add({x + body, 1.1}, Point<2>(0.2, 0.2), body);
        materials.of_body(body).initialize(core.points, 2 * body, 2 * body + 2);
      }
    core.sort();
    core.merger.apply(core, core.splitter, materials);
    EXPECT_EQ(core.points.size(), 4u) << "a film of two points";
    for (unsigned int p = 0; p < 4; ++p)
      core.points.data(core.points.reference_volume)[p] = 1.;
    core.merger.apply(core, core.splitter, materials);
    std::array<unsigned int, 2> n{{0, 0}};
    for (unsigned int p = 0; p < core.points.size(); ++p)
      ++n[core.points.data(core.points.body)[p]];
    EXPECT_EQ(n[0], 2u);
    EXPECT_EQ(n[1], 1u);
  }



  // Two rows of eight boxes each, 0.1 m long and 0.2 m high, are neighbours. A
  // film keeps twelve points in a cell: half as many again as boxes of half a
  // cell need. In thick soil each row becomes two boxes: none may be longer
  // than 0.5 m.
  TEST(Merger, FilmsAreMergedOnlyInFullCells)
  {
    for (const bool is_thin : {true, false})
      {
        Merging<3>   core;
        Materials<3> materials(
          {{"clay", "linear elastic"}, {"rubber", "neo-Hookean"}});
        materials.assign({"soil"}, {"clay"});
        core.merger.open_accounts(core.accounts);
        for (unsigned int i = 0; i < 16; ++i)
          core.add({1.15 + 0.1 * (i / 2), 1.1, 1.2 + 0.5 * (i % 2)},
                   Point<3>(0.1, 0.2, 0.1));
        if (!is_thin)
          for (unsigned int p = 0; p < 16; ++p)
            core.points.data(core.points.reference_volume)[p] = 1.;
        core.sort();
        core.merger.apply(core, core.splitter, materials);
        EXPECT_EQ(core.points.size(), is_thin ? 12u : 4u);
      }
  }



  TEST(Merger, WhatWouldBeSplitIsRefused)
  {
    const auto message = [](const std::string &splitter) {
      Merging<2> core(in_section("Splitting", splitter));
      return message_of<ExcUser>([&]() {
        core.merger.prepare(core.splitter, core.transfer.box_shape());
      });
    };
    EXPECT_EQ(message(""), "");
    EXPECT_EQ(message("set Minimum length = 0"), "");
    EXPECT_TRUE(contains(message("set Shear = counted\nset Directions = all"),
                         "'Splitting/Merge = false'"));
  }



  // ------------------------------------------------------- what becomes of it

  /// A random state with a box of these lengths now, and columns of all kinds.
  template <int dim>
  unsigned int
  add_parent(Merging<dim> &core, const BoxRule rule)
  {
    auto &points = core.points;
    points.add_column("plastic strain", "-", 1, Inheritance::copied);
    points.add_column("heat", "J", 2, Inheritance::divided);
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 1.5;
    const unsigned int p = core.add(x, core.vector(0.2, 0.3));
    core.randomize(p);
    for (const std::string name : {"plastic strain", "heat"})
      points.data(points.find(name))[p] = core.number(1., 2.);
    points.data(points.plastic_work)[p] = 7.;
    points.data(points.id)[p]           = 3.;
    begin_stretch(points, p, p + 1, rule);
    for (unsigned int d = 0; d < dim; ++d)
      points.data(points.length_at_creation, d)[p] *= 0.7;
    core.splitter.number_from(100, 1);
    core.sort();
    return p;
  }



  template <int dim>
  void
  expect_parent_back(const std::string &directions, const std::string &rule)
  {
    SCOPED_TRACE(directions + ", " + rule);
    Merging<dim> core(in_section("Splitting",
                                 "set Minimum length = 0\nset Threshold = 1.3\n"
                                 "set Directions = " +
                                   directions) +
                        in_section("Transfer", "set Box rule = " + rule),
                      "set Merge tolerance = 0");
    auto        &points = core.points;
    add_parent(core, core.transfer.box_shape().rule);
    std::vector<double> parent;
    for (unsigned int a = 0; a < points.n_arrays(); ++a)
      parent.push_back(points.data(a)[0]);
    const unsigned int n_columns = parent.size();
    for (unsigned int k = 0; k < dim; ++k)
      parent.push_back(transpose(core.edges(0))[k].norm());
    ASSERT_TRUE(core.split());
    core.sort();
    ASSERT_EQ(points.size(), 1u << dim);
    EXPECT_NEAR(core.merge(), 0., 1e-30);
    ASSERT_EQ(points.size(), 1u);
    for (const Column &column : points.columns())
      for (unsigned int c = 0; c < column.n_components; ++c)
        {
          const unsigned int expected =
            (column.first == points.length_at_creation ? n_columns
                                                       : column.first) +
            c;
          EXPECT_NEAR(points.data(column.first, c)[0],
                      parent[expected],
                      1e-12 * std::max(1., std::abs(parent[expected])))
            << column.name << ' ' << c;
        }
    EXPECT_LT(core.merger.conservation_error(), 1e-15);
  }



  TEST(Merger, ChildrenGiveTheirParent)
  {
    for (const std::string directions : {"all", "stretched"})
      for (const std::string rule : {"axis-parallel", "convected domain"})
        {
          expect_parent_back<2>(directions, rule);
          expect_parent_back<3>(directions, rule);
        }
  }



  /// What merging must keep, and the kinetic energy.
  template <int dim>
  struct Sums
  {
    explicit Sums(const Core<dim> &core)
    {
      const auto &points = core.points;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const double m = points.data(points.mass)[p], V = core.volume(p);
          mass[points.data(points.body)[p]] += m;
          volume += V;
          momentum += m * core.get(points.velocity, p);
          moment += m * core.get(points.position, p);
          initial_moment += m * core.get(points.initial_position, p);
          stress += V * core.stress(p);
          pressure += V * points.data(points.pore_pressure())[p];
          elastic += points.data(points.elastic_energy)[p];
          kinetic += 0.5 * m * core.get(points.velocity, p).norm_square();
          reference_volume += points.data(points.reference_volume)[p];
        }
    }

    std::map<unsigned int, double> mass;
    double                         volume = 0, elastic = 0, kinetic = 0;
    double                         reference_volume = 0, pressure = 0;
    Tensor<1, dim>                 momentum, moment, initial_moment;
    Tensor<2, dim>                 stress;
  };



  /// Points of two bodies, on a lattice that is not quite regular, with random
  /// states.
  template <int dim>
  void
  add_lattice(Core<dim> &core, const bool reversed = false)
  {
    constexpr unsigned int    n_per_axis = 16; // 4 per cell
    const double              spacing    = 4. / n_per_axis;
    std::vector<unsigned int> order(
      dealii::Utilities::fixed_power<dim>(n_per_axis));
    std::iota(order.begin(), order.end(), 0);
    if (reversed)
      std::reverse(order.begin(), order.end());
    for (const unsigned int i : order)
      {
        core.random.seed(i + 1);
        Point<dim> x;
        for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n_per_axis)
          x[d] = spacing * (rest % n_per_axis + core.number(0.4, 0.6));
        const auto         length = core.vector(0.9 * spacing, 1.1 * spacing);
        const unsigned int p = core.add(x, length, (x[0] + x[1] < 4. ? 0 : 1));
        core.randomize(p);
        core.points.data(core.points.pore_pressure())[p] =
          core.number(10., 100.);
        core.set_deformation(p,
                             core.tensor(-0.05, 0.05) +
                               typename Core<dim>::Tensor(
                                 dealii::unit_symmetric_tensor<dim>()));
      }
    core.sort();
  }



  const std::string for_lattice =
    "set Merge length = 0.55\nset Merge tolerance = 0.2";



  template <int dim>
  void
  expect_kept()
  {
    Merging<dim> core("", for_lattice);
    add_lattice(core);
    const unsigned int n_before = core.points.size();
    const Sums<dim>    before(core);
    const double       loss = core.merge();
    const Sums<dim>    after(core);
    const double       tolerance = 2e-14;
    EXPECT_EQ(core.points.size() + core.merger.n_merges(), n_before);
    EXPECT_EQ(core.points.n_sorted(), core.points.size());
    EXPECT_GT(core.merger.n_merges(), n_before / 4);
    for (const unsigned int body : {0, 1})
      EXPECT_NEAR(after.mass.at(body) / before.mass.at(body), 1., tolerance);
    EXPECT_NEAR(after.volume / before.volume, 1., tolerance);
    EXPECT_NEAR(after.reference_volume / before.reference_volume,
                1.,
                tolerance);
    EXPECT_NEAR(after.pressure / before.pressure, 1., tolerance);
    EXPECT_NEAR(after.elastic / before.elastic, 1., tolerance);
    EXPECT_LT((after.momentum - before.momentum).norm(),
              tolerance * std::sqrt(before.kinetic));
    EXPECT_LT((after.moment - before.moment).norm(),
              tolerance * before.moment.norm());
    EXPECT_LT((after.initial_moment - before.initial_moment).norm(),
              tolerance * before.initial_moment.norm());
    EXPECT_LT((after.stress - before.stress).norm(),
              tolerance * 100. * before.volume);
    EXPECT_GT(loss, 0.1 * before.kinetic);
    EXPECT_NEAR((before.kinetic - after.kinetic) / loss, 1., tolerance);
    EXPECT_LT(core.merger.conservation_error(), 1e-15);
  }



  TEST(Merger, KeepsMassVolumeMomentumAndBooksTheLoss)
  {
    expect_kept<2>();
    expect_kept<3>();
  }



  TEST(Merger, LossIncludesThatOfTheAddedMass)
  {
    double loss[2];
    for (const unsigned int i : {0, 1})
      {
        Merging<2> core("", for_lattice);
        add_lattice(core);
        loss[i] = core.merge(i == 0 ? std::vector<double>()
                                    : std::vector<double>{0.5, 0.5});
      }
    EXPECT_NEAR(loss[1] / loss[0], 1.5, 1e-14);
  }



  // Ranks differ in the order of points and in their numbers.
  TEST(Merger, OrderOfThePointsDoesNotMatter)
  {
    std::map<double, double> mass_at[2];
    for (const bool reversed : {false, true})
      {
        Merging<2> core("", for_lattice);
        add_lattice(core, reversed);
        core.merge();
        for (unsigned int p = 0; p < core.points.size(); ++p)
          // To what round-off leaves.
          mass_at[reversed]
                 [std::round(1e9 * core.points.data(core.points.position)[p])] =
                   core.points.data(core.points.mass)[p];
      }
    ASSERT_EQ(mass_at[0].size(), mass_at[1].size());
    for (auto a = mass_at[0].begin(), b = mass_at[1].begin();
         a != mass_at[0].end();
         ++a, ++b)
      {
        EXPECT_EQ(a->first, b->first);
        EXPECT_NEAR(a->second, b->second, 1e-14);
      }
  }



  // ------------------------------------------------------------- hysteresis

  /// Stretch all points along x about the middle of their cell.
  void
  stretch(Core<2> &core, const double factor)
  {
    auto &points = core.points;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        core.stretch(p, 0, factor);
        double &x = points.data(points.position)[p];
        x         = 1.5 + (x - 1.5) * factor;
      }
  }



  struct Counts
  {
    unsigned long n_splits, n_merges;
  };



  /// A point of half a cell whose length goes from there to @p first and then
  /// to and fro between @p least and @p most, in cells.
  Counts
  split_and_merge(const double most, const double least)
  {
    Merging<2> core(in_section("Splitting", "set Directions = stretched"));
    core.add({1.5, 1.5}, Point<2>(0.5, 0.3));
    core.sort();
    double     length = 0.5;
    const auto go_to  = [&](const double target) {
      const unsigned int n_steps = 100;
      const double       factor  = std::pow(target / length, 1. / n_steps);
      for (unsigned int i = 0; i < n_steps; ++i)
        {
          stretch(core, factor);
          core.split();
          core.sort();
          core.merge();
        }
      length = target;
    };
    for (unsigned int cycle = 0; cycle < 5; ++cycle)
      {
        go_to(most);
        go_to(least);
      }
    return {core.splitter.statistics().n_splits, core.merger.n_merges()};
  }



  TEST(Merger, NeverAlternatesWithSplitting)
  {
    // Never so long that it is split.
    Counts counts = split_and_merge(0.69, 0.4);
    EXPECT_EQ(counts.n_splits, 0u);
    EXPECT_EQ(counts.n_merges, 0u);
    // Split once; a swing by a quarter merges nothing.
    counts = split_and_merge(0.72, 0.72 / 1.25);
    EXPECT_EQ(counts.n_splits, 1u);
    EXPECT_EQ(counts.n_merges, 0u);
    // A swing by half: once per cycle.
    counts = split_and_merge(0.8, 0.4);
    EXPECT_EQ(counts.n_splits, 5u);
    EXPECT_EQ(counts.n_merges, 5u);
  }
} // namespace
