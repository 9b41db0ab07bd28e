// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  std::string
  splitting(const std::string &directions, const std::string &threshold)
  {
    return in_section("Splitting",
                      std::string(directions == "all" ? "set Shear = counted\n"
                                                      : "") +
                        "set Threshold = " + threshold +
                        "\nset Directions = " + directions);
  }



  /// A point with a box of these lengths at its creation, in a random state.
  template <int dim>
  unsigned int
  add_box(Core<dim> &core, const Point<dim> &x, const Tensor<1, dim> &length)
  {
    const unsigned int p = core.add(x, length);
    core.randomize(p);
    core.set_undeformed(p, length);
    return p;
  }



  /// Largest change of mass, momentum, force or volume of a node, each relative
  /// to the largest of its kind.
  template <int dim>
  double
  change(const std::vector<NodeSums<dim>> &a,
         const std::vector<NodeSums<dim>> &b)
  {
    double result = 0;
    for (unsigned int c = 0; c < SumIndex<dim>::n_entries; ++c)
      {
        double difference = 0, scale = 0;
        for (unsigned int n = 0; n < a.size(); ++n)
          {
            difference = std::max(difference, std::abs(a[n][c] - b[n][c]));
            scale      = std::max(scale, std::abs(a[n][c]));
          }
        EXPECT_GT(scale, 0.);
        result = std::max(result, difference / scale);
      }
    return result;
  }



  template <int dim>
  double
  length(const Core<dim> &core, const unsigned int p, const unsigned int d)
  {
    return core.points.data(core.points.box_length, d)[p];
  }



  /// No box is longer than the cell it is in.
  template <int dim>
  void
  expect_boxes_fit(const Core<dim> &core)
  {
    for (const Segment &segment : core.points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_LE(length(core, p, d),
                    (1. + 1e-9) * core.grid.cells()[segment.cell].size);
  }



  /// Cells of 1 m beyond x = 2 m (and z = 2 m), of 0.5 m before. A point goes
  /// from a large one to @p x in a small one.
  template <int dim>
  void
  expect_split_on_entry(const std::string    &directions,
                        const Point<dim>     &x,
                        const Tensor<1, dim> &lengths,
                        const unsigned int    n_children)
  {
    // The threshold alone would never split.
    Core<dim> core(cube<dim>() + splitting(directions, "1000"));
    refine_corner(core);
    Point<dim> start = x;
    start[0]         = 2.01;
    add_box(core, start, lengths);
    core.sort();
    ASSERT_EQ(core.grid.cells()[core.points.segments()[0].cell].size, 1.);
    EXPECT_FALSE(core.split());

    // Weights of the whole box, from the cell it comes from.
    core.set(core.points.position, 0, x);
    const auto before = core.scatter();
    ASSERT_TRUE(core.split());
    EXPECT_EQ(core.points.size(), n_children);
    core.sort();
    expect_boxes_fit(core);
    EXPECT_LT(change<dim>(before, core.scatter()), 1e-12);
    EXPECT_LE(core.splitter.statistics().conservation_error, 1e-12);
    EXPECT_FALSE(core.split()) << "at once";
  }



  TEST(GradedSplits, APointSplitsWhereItEntersASmallerCell)
  {
    // Children at 1.97 -+ 0.23 m: on both sides of the change of size. Boxes
    // end within the cells around the one the point comes from.
    const Point<2> x(1.97, 0.8);
    expect_split_on_entry<2>("all", x, Tensor<1, 2>({0.92, 0.6}), 4);
    expect_split_on_entry<2>("all", x, Tensor<1, 2>({0.92, 0.4}), 4);
    expect_split_on_entry<2>("stretched", x, Tensor<1, 2>({0.92, 0.6}), 4);
    expect_split_on_entry<2>("stretched", x, Tensor<1, 2>({0.92, 0.4}), 2);
    expect_split_on_entry<2>("stretched", x, Tensor<1, 2>({0.4, 0.92}), 2);
    const Point<3> y(1.97, 1.8, 0.8);
    expect_split_on_entry<3>("all", y, Tensor<1, 3>({0.92, 0.6, 0.6}), 8);
    expect_split_on_entry<3>("stretched", y, Tensor<1, 3>({0.92, 0.6, 0.6}), 8);
    expect_split_on_entry<3>("stretched", y, Tensor<1, 3>({0.4, 0.6, 0.3}), 2);
  }



  /// What fits stays as it is.
  TEST(GradedSplits, ASmallPointEntersUnsplit)
  {
    Core<2> core(cube<2>() + splitting("all", "1000"));
    refine_corner(core);
    add_box(core, {2.01, 0.8}, Tensor<1, 2>({0.4999, 0.5}));
    core.sort();
    core.set(core.points.position, 0, Point<2>(1.97, 0.8));
    EXPECT_FALSE(core.split());
    core.sort();
    EXPECT_FALSE(core.split());
  }



  /// Points of any length up to that of their cell, stretched along x beyond
  /// the threshold, where the size of the cells changes: whether children lie
  /// in smaller or larger cells, nodes must not notice.
  template <int dim>
  void
  expect_invariance(const std::string &directions, const unsigned int seed)
  {
    Core<dim> core(cube<dim>() + splitting(directions, "1.5"));
    refine_corner(core);
    core.random.seed(seed);
    Point<dim> x(core.vector(0.6, 3.4));
    x[seed % 2 == 0 ? 0 : dim - 1] = 2. + core.number(-0.3, 0.3);
    const double   size = core.grid.cells()[core.grid.find_cell(x)].size;
    Tensor<1, dim> lengths;
    // No child is below the floor of her cell, 0.2 m at most.
    for (unsigned int d = 0; d < dim; ++d)
      lengths[d] = size * core.number(size < 1. ? 0.82 : 0.45, 0.999);
    lengths[0]           = size * core.number(size < 1. ? 0.82 : 0.71, 0.999);
    const unsigned int p = add_box(core, x, lengths);
    core.points.data(core.points.length_at_creation)[p] /= 1.6;
    core.sort();
    const auto before = core.scatter();
    ASSERT_TRUE(core.split());
    core.sort();
    EXPECT_LT(change<dim>(before, core.scatter()), 1e-12)
      << "at " << x << " with " << lengths;
    expect_boxes_fit(core);
    EXPECT_LE(core.splitter.statistics().conservation_error, 1e-12);
  }



  TEST(GradedSplits, NodesDoNotNoticeWhereSizesChange)
  {
    for (const std::string directions : {"all", "stretched"})
      for (unsigned int seed = 1; seed <= 60; ++seed)
        {
          SCOPED_TRACE(text(directions, ", seed ", seed));
          expect_invariance<2>(directions, seed);
          if (seed <= 20)
            expect_invariance<3>(directions, seed);
        }
  }
} // namespace
