// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/weights_kernel.h>

#include <deal.II/base/tensor.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Tensor;

  // More than a register of any machine holds, and a rest.
  constexpr unsigned int n_points = 27;

  /// Polar decomposition by deal.II: R by a singular value decomposition.
  template <int dim>
  void
  expect_polar_decomposition()
  {
    Core<dim>    core(cube<dim>());
    auto        &points = core.points;
    const double length = 0.7; // of squares or cubes
    points.append(n_points);
    for (unsigned int round = 0; round < 50; ++round)
      {
        std::vector<Tensor<2, dim>> F(n_points);
        for (unsigned int p = 0; p < n_points; ++p)
          {
            do
              F[p] = core.tensor(-2., 2.);
            while (determinant(F[p]) < 0.05);
            core.set(points.edges, p, length * F[p]);
          }
        const auto expect_diagonal = [&](const auto &factor) {
          for (unsigned int p = 0; p < n_points; ++p)
            {
              const auto R = dealii::project_onto_orthogonal_tensors(F[p]);
              ASSERT_GT(determinant(R), 0.);
              for (unsigned int d = 0; d < dim; ++d)
                EXPECT_NEAR(points.data(points.box_length, d)[p] / length,
                            factor(F[p], transpose(R))[d][d],
                            1e-13);
            }
        };
        update_box_lengths(points, 0, points.size(), BoxRule::left_stretch);
        expect_diagonal([](const auto &F, const auto &R_T) { return F * R_T; });
      }
  }



  TEST(BoxRule, PolarDecomposition)
  {
    expect_polar_decomposition<2>();
  }



  // Second moments of the cell: a turned square keeps its lengths, a sheared
  // row keeps its height, and unequal edges turn with the material.
  TEST(BoxRule, SecondMoments)
  {
    Core<2>      core(cube<2>());
    auto        &points = core.points;
    const double c = std::cos(0.4), s = std::sin(0.4);
    const auto   lengths =
      [&](const double L_x, const double L_y, const Tensor<2, 2> &F) {
        const unsigned int p = core.add({1.5, 1.5}, dealii::Point<2>(L_x, L_y));
        core.set_deformation(p, F);
        update_box_lengths(points, p, p + 1, BoxRule::second_moments);
        return core.get(points.box_length, p);
      };
    const auto expect =
      [](const Tensor<1, 2> &l, const double x, const double y) {
        EXPECT_NEAR(l[0], x, 1e-15);
        EXPECT_NEAR(l[1], y, 1e-15);
      };
    expect(lengths(0.4, 0.4, Tensor<2, 2>({{c, -s}, {s, c}})), 0.4, 0.4);
    expect(lengths(0.4, 0.2, Tensor<2, 2>({{0., -1.}, {1., 0.}})), 0.2, 0.4);
    expect(lengths(0.3, 0.4, Tensor<2, 2>({{1., 1.}, {0., 1.}})), 0.5, 0.4);
  }



  /// A random cell with its box, and a second one whose cell is deformed
  /// before its creation: the smallest box around the corners.
  template <int dim>
  void
  expect_extents()
  {
    Core<dim>     core(cube<dim>());
    auto         &points = core.points;
    const BoxRule rule   = BoxRule::convected_domain;
    for (unsigned int i = 0; i < n_points; ++i)
      {
        core.add(core.place(), core.vector(0.2, 0.5));
        core.set_deformation(i,
                             core.tensor(-0.5, 0.5) +
                               Tensor<2, dim>(
                                 dealii::unit_symmetric_tensor<dim>()));
      }
    const Tensor<1, dim> before = core.get(points.length_at_creation, 0);
    update_box_lengths(points, 0, n_points, rule);
    EXPECT_EQ(core.get(points.length_at_creation, 0), before);
    for (const bool begins : {false, true})
      {
        if (begins)
          begin_stretch(points, 0, n_points, rule);
        for (unsigned int p = 0; p < n_points; ++p)
          {
            Tensor<1, dim> farthest;
            for (unsigned int v = 0; v < (1u << dim); ++v)
              {
                Tensor<1, dim> signs;
                for (unsigned int k = 0; k < dim; ++k)
                  signs[k] = (v >> k & 1) ? 0.5 : -0.5;
                const Tensor<1, dim> corner = core.edges(p) * signs;
                for (unsigned int d = 0; d < dim; ++d)
                  farthest[d] = std::max(farthest[d], corner[d]);
              }
            const auto box = core.get(points.box_length, p);
            EXPECT_LT((box - 2. * farthest).norm(), 1e-15);
            // The splitter looks at the edges, not at the box around them.
            if (begins)
              for (unsigned int k = 0; k < dim; ++k)
                EXPECT_NEAR(points.data(points.length_at_creation, k)[p],
                            transpose(core.edges(p))[k].norm(),
                            1e-15);
          }
      }
  }



  TEST(BoxRule, ExtentsOfConvectedDomains)
  {
    expect_extents<2>();
    expect_extents<3>();
  }



  TEST(BoxRule, HalfLengthsAreClipped)
  {
    Core<2>    core(cube<2>());
    const auto half = [&](const double length, const double stretch) {
      const BoxShape     shape;
      const unsigned int p = core.add({1.5, 1.5}, dealii::Point<2>(9., length));
      core.stretch(p, 1, stretch);
      // Cells of 2 m.
      return half_length_in_cells<2>(core.points, shape, 1, p, 0.5);
    };
    EXPECT_EQ(half(1., 1.5), 0.375);
    EXPECT_EQ(half(1., 0.3), 0.1);
    EXPECT_EQ(half(1., 2.1), 0.5);
  }



  TEST(BoxRule, ClippedAxesAreCounted)
  {
    Core<2> core(cube<2>());
    core.refine([](const dealii::Point<2> &x) { return x.norm() < 1.; });
    const auto add = [&](const dealii::Point<2> &x,
                         const double            length_x,
                         const double            stretch_x,
                         const double            length_y) {
      const unsigned int p = core.add(x, dealii::Point<2>(length_x, length_y));
      core.stretch(p, 0, stretch_x);
    };
    // Half-sizes from 0.1 to 0.5 of a cell of 1 m, the ends included.
    add({2.5, 2.5}, 0.5, 1., 1.);
    add({2.5, 2.5}, 0.5, 2., 0.2);
    add({2.5, 2.5}, 0.5, 2.01, 1.01); // both
    add({2.5, 2.5}, 0.5, 0.39, 0.5);  // x too short
    // In a cell of 0.5 m.
    add({0.25, 0.25}, 0.5, 1., 0.1);
    add({0.25, 0.25}, 0.5, 1.1, 0.09); // both
    core.sort();
    BoxShape shape;
    EXPECT_EQ(count_clipped_boxes(core.points, core.grid, shape), 5u);
  }
} // namespace
