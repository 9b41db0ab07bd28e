// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/points_kernel.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  std::string
  splitting(const std::string &entries)
  {
    return in_section("Splitting",
                      "set Shear = counted\nset Directions = all\n" + entries);
  }



  /// One point of @p length along x before any stretch, m, that is stretched
  /// along x, also at its creation; returns the number of points after.
  template <int dim>
  unsigned int
  count_after(const std::string &parameters,
              const double       length,
              const double       stretch,
              const double       creation_stretch = 1.,
              const unsigned int generation       = 0)
  {
    Core<dim>      core(cube<dim>() + splitting(parameters));
    auto          &points = core.points;
    Point<dim>     x;
    Tensor<1, dim> lengths;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = 1.5, lengths[d] = 0.1;
    lengths[0]           = length;
    const unsigned int p = core.add(x, lengths);
    core.stretch(p, 0, stretch);
    points.data(points.length_at_creation)[p] = creation_stretch * length;
    points.data(points.generation)[p]         = generation;
    core.sort();
    const bool has_split = core.split();
    EXPECT_EQ(has_split, points.size() > 1);
    EXPECT_EQ(core.splitter.statistics().n_splits, has_split ? 1u : 0u);
    return points.size();
  }



  /// The same for a point of 1.08 m height at y.
  unsigned int
  count_after_at_height(const double y)
  {
    Core<2>            core(cube<2>() + splitting("set Threshold = 1.1"));
    const Tensor<1, 2> length({0.1, 0.9});
    const unsigned int p = core.add(Point<2>(1.5, y), length);
    core.stretch(p, 1, 1.2);
    core.sort();
    core.split();
    core.sort(); // throws if a child is too far outside
    return core.points.size();
  }



  // --------------------------------------------------------------- criterion

  TEST(Splitter, WaitsWhereChildrenWouldLieBeyondAWall)
  {
    // They lie 0.27 m farther out; half of a cell of 1 m is allowed.
    EXPECT_EQ(count_after_at_height(-0.2), 4u);
    EXPECT_EQ(count_after_at_height(-0.3), 1u);
  }



  TEST(Splitter, ThresholdIsExact)
  {
    // Cells of 1 m; the length must exceed 0.7 m, too.
    const std::string beta = "set Threshold = 1.5";
    EXPECT_EQ(count_after<2>(beta, 0.5, 1.5), 1u);
    EXPECT_EQ(count_after<2>(beta, 0.5, std::nextafter(1.5, 2.)), 4u);
    EXPECT_EQ(count_after<3>(beta, 0.5, 1.5), 1u);
    EXPECT_EQ(count_after<3>(beta, 0.5, std::nextafter(1.5, 2.)), 8u);
    // Relative to the stretch at creation.
    EXPECT_EQ(count_after<2>(beta, 0.25, 3., 2.), 1u);
    EXPECT_EQ(count_after<2>(beta, 0.25, 3.0001, 2.), 4u);
    EXPECT_EQ(count_after<2>(beta, 0.9, 0.9, 0.5), 4u);
  }



  TEST(Splitter, MinimumLength)
  {
    // Lengths of 0.75 m and a bit.
    const std::string least = "set Threshold = 1.2\nset Minimum length = 0.75";
    EXPECT_EQ(count_after<2>(least, 0.5, 1.5), 1u);
    EXPECT_EQ(count_after<2>(least, 0.5, std::nextafter(1.5, 2.)), 4u);
    const std::string off = "set Threshold = 1.2\nset Minimum length = 0";
    EXPECT_EQ(count_after<2>(off, 0.01, 1.21), 4u);
    EXPECT_EQ(count_after<2>(off, 0.01, 1.2), 1u);
  }



  TEST(Splitter, LongerThanACellWhateverTheThreshold)
  {
    const std::string beta = "set Threshold = 100";
    EXPECT_EQ(count_after<2>(beta, 0.8, 1.25), 1u);
    EXPECT_EQ(count_after<2>(beta, 0.8, 1.25 * (1 + 0.9e-9)), 1u);
    EXPECT_EQ(count_after<2>(beta, 0.8, 1.25 * (1 + 1.1e-9)), 4u);
    EXPECT_EQ(count_after<2>(beta, 1.2, 1.), 4u);
  }



  TEST(Splitter, LengthsAreInUnitsOfTheOwnCell)
  {
    Core<2> core(cube<2>() + splitting("set Threshold = 1.2"));
    refine_corner(core);
    auto &points = core.points;
    // 0.48 m: below 0.7 of the large cell, above 0.7 of the small one.
    for (const Point<2> x : {Point<2>(0.25, 0.25), Point<2>(3.5, 3.5)})
      {
        const unsigned int p = core.add(x, Point<2>(0.3, 0.1));
        core.stretch(p, 0, 1.6);
      }
    core.sort();
    EXPECT_TRUE(core.split());
    EXPECT_EQ(core.splitter.statistics().n_splits, 1u);
    // The child in her parent's place may lie in another cell.
    EXPECT_EQ(core.workspace.points_out_of_cell().size(), 1u);
    for (unsigned int p = 0; p < points.size(); ++p)
      EXPECT_EQ(points.data(points.generation)[p],
                points.data(points.position)[p] < 2. ? 1. : 0.);
  }



  TEST(Splitter, GenerationLimit)
  {
    const std::string three = "set Maximum generation = 3";
    EXPECT_EQ(count_after<2>(three, 0.6, 1.5, 1., 2), 4u);
    EXPECT_EQ(count_after<2>(three, 0.6, 1.5, 1., 3), 1u);
    // More than slides need.
    EXPECT_EQ(count_after<2>("", 0.6, 1.5, 1., 11), 4u);
    EXPECT_EQ(count_after<2>("", 0.6, 1.5, 1., 12), 1u);
    EXPECT_EQ(count_after<2>("set Maximum generation = 0", 0.6, 1.5), 1u);
    EXPECT_EQ(count_after<2>("set Enabled = false", 0.6, 1.5), 1u);

    Core<2> core(cube<2>() + splitting("set Maximum generation = 2"));
    core.add({1.5, 1.5}, Point<2>(3., 3.));
    core.stretch(0, 0, 1.5);
    core.sort();
    // 4.5 m: one split, then four, then sixteen refusals.
    for (unsigned int n : {4u, 16u, 16u})
      {
        core.split();
        core.sort();
        EXPECT_EQ(core.points.size(), n);
      }
    EXPECT_EQ(core.splitter.statistics().n_splits, 5u);
    EXPECT_EQ(core.splitter.statistics().largest_generation, 2u);
  }



  // -------------------------------------------------------- points at limits

  /// The points that a limit keeps from being split, of one point at @p x with
  /// a box of @p length along x, m, stretched by @p stretch since its creation.
  UnsplitPoints
  count_unsplit(const std::string &parameters,
                const Point<2>    &x,
                const double       length,
                const double       stretch,
                const unsigned int generation = 0)
  {
    Core<2>            core(cube<2>() + splitting(parameters));
    const unsigned int p = core.add(x, Point<2>(length / stretch, 0.4));
    core.stretch(p, 0, stretch);
    core.points.data(core.points.generation)[p] = generation;
    core.sort();
    core.split();
    core.sort();
    return core.splitter.count_unsplit(core.points, core.grid);
  }



  void
  expect_counts(const UnsplitPoints &count,
                const unsigned long  at_generation_limit,
                const unsigned long  at_mesh_limit,
                const unsigned long  at_length_limit)
  {
    EXPECT_EQ(count.at_generation_limit, at_generation_limit);
    EXPECT_EQ(count.at_mesh_limit, at_mesh_limit);
    EXPECT_EQ(count.at_length_limit, at_length_limit);
  }



  // Cells of 1 m, threshold 1.4, minimum length 0.7 m.
  TEST(Splitter, PointsAtLimitsAreCounted)
  {
    const std::string two = "set Maximum generation = 2";
    const Point<2>    inside(1.5, 1.5), at_wall(-0.4, 1.5);
    // Split, and neither child is at a limit.
    expect_counts(count_unsplit("", inside, 0.9, 1.5), 0, 0, 0);
    expect_counts(count_unsplit(two, inside, 0.9, 1.5, 1), 0, 0, 0);
    // Not to be split.
    expect_counts(count_unsplit(two, inside, 0.9, 1.3, 2), 0, 0, 0);
    // By the threshold, or longer than a cell whatever the threshold says.
    expect_counts(count_unsplit(two, inside, 0.9, 1.5, 2), 1, 0, 0);
    expect_counts(count_unsplit(two, inside, 1.1, 1.2, 2), 1, 0, 0);
    // Children at -0.4 -+ 0.225 m, half a cell is allowed.
    expect_counts(count_unsplit("", at_wall, 0.9, 1.5), 0, 1, 0);
    expect_counts(count_unsplit(two, at_wall, 0.9, 1.5, 2), 1, 0, 0);
    // Stretched, but shorter than the minimum length.
    expect_counts(count_unsplit("", inside, 0.6, 1.5), 0, 0, 1);
    expect_counts(count_unsplit(two, at_wall, 0.6, 1.5, 2), 0, 0, 1);
    expect_counts(count_unsplit("", inside, 0.6, 1.3), 0, 0, 0);
    // Switched off by the user.
    expect_counts(count_unsplit("set Enabled = false", inside, 1.5, 1.5),
                  0,
                  0,
                  0);
  }



  // The other ranks have 7 of the 10 points, so that 5 points are left of a
  // maximum of 12: the three points here cannot become six.
  TEST(Splitter, BudgetIsSharedWithOtherRanks)
  {
    for (const unsigned int budget : {12, 13})
      {
        Core<2> core(
          cube<2>() +
          splitting(text("set Maximum number of points = ", budget)));
        for (unsigned int i = 0; i < 3; ++i)
          {
            core.add(Point<2>(0.5 + i, 0.5), Point<2>(0.6, 0.6));
            core.stretch(i, 0, i == 1 ? 1.5 : 1.);
          }
        core.sort();
        core.splitter.check_total(10., 3.);
        const std::string said = message_of<ExcPoint>([&]() { core.split(); });
        if (budget == 13)
          EXPECT_EQ(said, "");
        else
          EXPECT_TRUE(contains(said, "would make 13 points on all ranks"))
            << said;
      }
  }



  TEST(Splitter, BudgetOfPoints)
  {
    const auto enforce = [](const unsigned int budget) {
      Core<2> core(cube<2>() +
                   splitting(text("set Maximum number of points = ", budget)));
      for (unsigned int i = 0; i < 3; ++i)
        {
          core.add(Point<2>(0.5 + i, 0.5), Point<2>(0.6, 0.6));
          core.stretch(i, 0, i == 1 ? 1.5 : 1.);
        }
      core.sort();
      const std::string message = message_of<ExcPoint>([&]() { core.split(); });
      EXPECT_EQ(core.points.size(), message.empty() ? 6u : 3u);
      return message;
    };
    EXPECT_EQ(enforce(6), "");
    const std::string message = enforce(5);
    for (const std::string part : {"point 1",
                                   "(1.5 0.5) m",
                                   "6 points",
                                   "'Splitting/Maximum number of points' = 5",
                                   "'Splitting/Maximum generation'"})
      EXPECT_TRUE(contains(message, part)) << message;
  }



  // --------------------------------------------------------------- children

  /// F that stretches edge k by stretch[k], otherwise random.
  template <int dim>
  Tensor<2, dim>
  stretching_edges(Core<dim> &core, const Tensor<1, dim> &stretch)
  {
    Tensor<2, dim> rows = core.tensor(-0.3, 0.3);
    for (unsigned int k = 0; k < dim; ++k)
      {
        rows[k][k] += 1.;
        rows[k] *= stretch[k] / rows[k].norm();
      }
    return transpose(rows);
  }



  /// F = V R with stretches along the axes and a random R.
  template <int dim>
  Tensor<2, dim>
  stretching_axes(Core<dim> &core, const Tensor<1, dim> &stretch)
  {
    Tensor<2, dim> F = dealii::project_onto_orthogonal_tensors(
      core.tensor(-0.5, 0.5) +
      Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()));
    for (unsigned int d = 0; d < dim; ++d)
      F[d] *= stretch[d];
    return F;
  }



  /// A point with id 1 in a random state with columns of both kinds, stretched
  /// along the edges or axes whose bits are set, and its copy with id 2, which
  /// is at the generation limit and stays what it is. Cells are squares or
  /// cubes where shear is counted, as the rule for their boxes demands.
  template <int dim>
  void
  add_parent(Core<dim> &core, const unsigned int axes)
  {
    auto &points = core.points;
    points.add_column("plastic strain", "-", 1, Inheritance::copied);
    points.add_column("heat", "J", 2, Inheritance::divided);
    core.add(core.place(0.5), core.vector(0.2, 0.3));
    const BoxRule  rule    = core.transfer.box_shape().rule;
    const bool     by_axes = rule == BoxRule::left_stretch;
    Tensor<1, dim> length  = core.vector(0.4, 0.5), stretch;
    for (unsigned int d = 0; d < dim; ++d)
      {
        length[d]  = by_axes ? length[0] : length[d];
        stretch[d] = (axes >> d & 1) ? 1.9 : 1.1;
      }
    const unsigned int p = core.add(core.place(0.5), length);
    for (const Column &column : points.columns())
      for (unsigned int c = 0; c < column.n_components; ++c)
        if (column.first != points.position && column.first != points.body &&
            column.first != points.id && column.first != points.generation)
          points.data(column.first, c)[p] = core.number(1., 2.);
    core.set_undeformed(p, length);
    core.set_deformation(p,
                         by_axes ? stretching_axes(core, stretch)
                                 : stretching_edges(core, stretch));
    update_box_lengths(points, p, p + 1, rule);
    const unsigned int copy = points.append(1);
    points.copy(p, copy);
    points.data(points.id)[copy]         = 2;
    points.data(points.generation)[copy] = 3;
    core.splitter.number_from(100, 1);
    core.sort();
  }



  template <int dim>
  unsigned int
  index_of(const Core<dim> &core, const double id)
  {
    unsigned int p = 0;
    while (core.points.data(core.points.id)[p] != id)
      ++p;
    return p;
  }



  /// Edges and box of child @p q, which were halved in the directions
  /// @p halved.
  template <int dim>
  void
  expect_cell_of_child(const Core<dim>   &core,
                       const unsigned int parent,
                       const unsigned int q,
                       const unsigned int halved)
  {
    const auto          &points = core.points;
    const BoxRule        rule   = core.transfer.box_shape().rule;
    const Tensor<2, dim> A = core.edges(parent), A_q = core.edges(q);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double share = (halved >> d & 1) ? 0.5 : 1.;
        for (unsigned int i = 0; i < dim; ++i)
          EXPECT_EQ(A_q[i][d], share * A[i][d]);
        const double box = points.data(points.box_length, d)[q];
        if (rule == BoxRule::left_stretch)
          EXPECT_NEAR(box,
                      0.5 * points.data(points.box_length, d)[parent],
                      1e-15);
        else
          EXPECT_NEAR(box, A_q[d].norm(), 1e-15);
        EXPECT_NEAR(points.data(points.length_at_creation, d)[q],
                    rule == BoxRule::left_stretch ? box
                                                  : transpose(A_q)[d].norm(),
                    1e-15);
      }
  }



  /// Place of child @p q of a point that was split in the directions @p halved:
  /// along axes where shear is counted, along edges otherwise. Returns the
  /// corner of the parent where it lies, a bit per direction.
  template <int dim>
  unsigned int
  expect_place_of_child(const Core<dim>   &core,
                        const unsigned int parent,
                        const unsigned int q,
                        const unsigned int halved)
  {
    const auto          &points = core.points;
    const Tensor<1, dim> offset =
      core.get(points.position, q) - core.get(points.position, parent);
    Tensor<2, dim> directions = core.edges(parent);
    if (core.transfer.box_shape().rule == BoxRule::left_stretch)
      {
        directions = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          directions[d][d] = points.data(points.box_length, d)[parent];
      }
    const Tensor<1, dim> parts  = invert(directions) * offset;
    unsigned int         corner = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        EXPECT_NEAR(std::abs(parts[d]), (halved >> d & 1) ? 0.25 : 0., 1e-14);
        if (parts[d] > 1e-14)
          corner |= 1u << d;
      }
    // The deformation gradient carries the material offset to that now. This
    // holds for the first split of a point: afterwards the lengths at creation
    // are those of deformed edges, which no longer tell the stretch of each.
    const Tensor<1, dim> carried =
      core.deformation(parent) * (core.get(points.initial_position, q) -
                                  core.get(points.initial_position, parent));
    EXPECT_LT((carried - offset).norm(), 1e-14);
    return corner;
  }



  template <int dim>
  void
  expect_state_of_child(const Core<dim>   &core,
                        const unsigned int parent,
                        const unsigned int q,
                        const unsigned int n_children)
  {
    const auto &points = core.points;
    EXPECT_EQ(points.data(points.generation)[q], 1.);
    for (const Column &column : points.columns())
      for (unsigned int c = 0; c < column.n_components; ++c)
        if (column.first != points.position &&
            column.first != points.initial_position &&
            column.first != points.edges && column.first != points.box_length &&
            column.first != points.length_at_creation &&
            column.first != points.generation && column.first != points.id)
          {
            const bool divided = column.inheritance == Inheritance::divided;
            EXPECT_EQ(points.data(column.first, c)[q],
                      points.data(column.first, c)[parent] /
                        (divided ? n_children : 1))
              << column.name;
          }
  }



  template <int dim>
  void
  expect_children(const std::string &directions, const unsigned int axes)
  {
    Core<dim> core(
      cube<dim>() + splitting_along(directions) +
      in_section("Splitting",
                 "set Minimum length = 0.7\nset Maximum generation = 3"));
    auto &points = core.points;
    add_parent(core, axes);
    const unsigned int parent = index_of(core, 2), child = index_of(core, 1);
    const unsigned int n_before = points.size();
    ASSERT_TRUE(core.split());

    const unsigned int mask = directions == "all" ? (1u << dim) - 1 : axes;
    const unsigned int n    = 1u << __builtin_popcount(mask);
    ASSERT_EQ(points.size(), n_before + n - 1);
    std::map<unsigned int, unsigned int> ids, corners;
    for (unsigned int k = 0; k < n; ++k)
      {
        const unsigned int q = (k == 0 ? child : n_before + k - 1);
        ++ids[points.data(points.id)[q]];
        ++corners[expect_place_of_child(core, parent, q, mask)];
        expect_cell_of_child(core, parent, q, mask);
        expect_state_of_child(core, parent, q, n);
      }
    EXPECT_EQ(corners.size(), n) << "one child in each corner";
    EXPECT_EQ(ids.size(), n);
    EXPECT_EQ(ids.count(1), 1u) << "the first keeps its parent's id";
    for (unsigned int k = 0; k + 1 < n; ++k)
      EXPECT_EQ(ids.count(100 + k), 1u);
  }



  TEST(Splitter, ChildrenInheritTheState)
  {
    expect_children<2>("all", 1);
    expect_children<2>("stretched", 1);
    expect_children<2>("stretched", 2);
    expect_children<2>("stretched", 3);
    expect_children<3>("all", 4);
    for (unsigned int axes = 1; axes < 8; ++axes)
      expect_children<3>("stretched", axes);
  }



  /// What is extensive is divided, what is intensive is not.
  TEST(Splitter, KindsOfColumns)
  {
    const Points<2> points;
    for (const Column &column : points.columns())
      EXPECT_EQ(column.inheritance == Inheritance::divided,
                column.name == "mass" || column.name == "reference volume" ||
                  column.name == "elastic energy" ||
                  column.name == "plastic work")
        << column.name;
  }
} // namespace
