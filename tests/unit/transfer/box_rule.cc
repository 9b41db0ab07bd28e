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
    Core<dim> core(cube<dim>());
    auto     &points = core.points;
    points.append(n_points);
    core.workspace.reinit(0, n_points);
    for (unsigned int round = 0; round < 50; ++round)
      {
        std::vector<Tensor<2, dim>> F(n_points);
        for (unsigned int p = 0; p < n_points; ++p)
          {
            do
              F[p] = core.tensor(-2., 2.);
            while (determinant(F[p]) < 0.05);
            core.set_deformation(p, F[p]);
          }
        const auto expect_diagonal = [&](const auto &factor) {
          for (unsigned int p = 0; p < n_points; ++p)
            {
              const auto R = dealii::project_onto_orthogonal_tensors(F[p]);
              ASSERT_GT(determinant(R), 0.);
              for (unsigned int d = 0; d < dim; ++d)
                EXPECT_NEAR(points.data(points.stretch, d)[p],
                            factor(F[p], transpose(R))[d][d],
                            1e-13);
            }
        };
        update_stretch(points,
                       core.workspace,
                       0,
                       points.size(),
                       BoxRule::right_stretch,
                       0.1);
        expect_diagonal([](const auto &F, const auto &R_T) { return R_T * F; });
        update_stretch(
          points, core.workspace, 0, points.size(), BoxRule::left_stretch, 0.1);
        expect_diagonal([](const auto &F, const auto &R_T) { return F * R_T; });
      }
  }



  TEST(BoxRule, PolarDecomposition)
  {
    expect_polar_decomposition<2>();
    expect_polar_decomposition<3>();
  }



  /// F = R U with U = diag(1.3, 0.9, ...) and R by 90 degrees in the plane xy.
  template <int dim>
  void
  expect_stretch_after_quarter_turn()
  {
    Core<dim>      core(cube<dim>());
    auto          &points = core.points;
    Tensor<2, dim> F;
    F[0][1] = -0.9;
    F[1][0] = 1.3;
    if (dim == 3)
      F[dim - 1][dim - 1] = 1.1;
    core.set_deformation(points.append(1), F);
    core.workspace.reinit(0, 1);
    const auto expect =
      [&](const BoxRule rule, const double x, const double y) {
        update_stretch(points, core.workspace, 0, points.size(), rule, 0.1);
        EXPECT_NEAR(points.data(points.stretch, 0)[0], x, 1e-15);
        EXPECT_NEAR(points.data(points.stretch, 1)[0], y, 1e-15);
        for (unsigned int d = 2; d < dim; ++d)
          EXPECT_NEAR(points.data(points.stretch, d)[0], 1.1, 1e-15);
      };
    expect(BoxRule::right_stretch, 1.3, 0.9);
    expect(BoxRule::left_stretch, 0.9, 1.3);
    // F_dd vanishes, the stretch must not.
    expect(BoxRule::deformation_gradient, 0.01, 0.01);
  }



  TEST(BoxRule, QuarterTurn)
  {
    expect_stretch_after_quarter_turn<2>();
    expect_stretch_after_quarter_turn<3>();
  }



  TEST(BoxRule, DeformationGradientTakesTheDiagonal)
  {
    Core<3>      core(cube<3>());
    auto        &points = core.points;
    Tensor<2, 3> F;
    F[0][0] = 1.7, F[1][1] = 0.4, F[2][2] = 1.2;
    F[0][1] = 0.8, F[2][0] = -0.3;
    core.set_deformation(points.append(1), F);
    core.workspace.reinit(0, 1);
    update_stretch(points,
                   core.workspace,
                   0,
                   points.size(),
                   BoxRule::deformation_gradient,
                   0.1);
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_EQ(points.data(points.stretch, d)[0], F[d][d]);
  }



  /// With fixed boxes the stretch is exp(integral of D_dd dt).
  template <int dim>
  void
  expect_integrated_strain()
  {
    Core<dim> core(cube<dim>());
    auto     &points = core.points;
    for (unsigned int p = 0; p < n_points; ++p)
      core.add(core.place(), core.vector(0.2, 0.8));
    core.workspace.reinit(0, n_points);
    std::vector<Tensor<1, dim>> strain(n_points);
    for (unsigned int step = 0; step < 100; ++step)
      {
        const double dt = core.number(0.01, 0.1);
        for (unsigned int p = 0; p < n_points; ++p)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              {
                const double rate = core.number(-2., 2.);
                core.workspace.velocity_gradient(i, j)[p] = rate;
                if (i == j)
                  strain[p][i] += dt * rate;
              }
        update_stretch(
          points, core.workspace, 0, points.size(), BoxRule::fixed, dt);
      }
    for (unsigned int p = 0; p < n_points; ++p)
      for (unsigned int d = 0; d < dim; ++d)
        EXPECT_NEAR(points.data(points.stretch, d)[p] / std::exp(strain[p][d]),
                    1.,
                    1e-13);
  }



  TEST(BoxRule, FixedIntegratesTheStrain)
  {
    expect_integrated_strain<2>();
    expect_integrated_strain<3>();
  }



  TEST(BoxRule, HalfLengthsAreClipped)
  {
    Core<2>    core(cube<2>());
    const auto half = [&](const BoxRule rule,
                          const double  length,
                          const double  stretch) {
      BoxShape shape;
      shape.rule           = rule;
      const unsigned int p = core.add({1.5, 1.5}, dealii::Point<2>(9., length));
      core.points.data(core.points.stretch, 1)[p] = stretch;
      // Cells of 2 m.
      return half_length_in_cells<2>(core.points, shape, 1, p, 0.5);
    };
    EXPECT_EQ(half(BoxRule::right_stretch, 1., 1.5), 0.375);
    EXPECT_EQ(half(BoxRule::right_stretch, 1., 0.3), 0.1);
    EXPECT_EQ(half(BoxRule::right_stretch, 1., 2.1), 0.5);
    EXPECT_EQ(half(BoxRule::fixed, 1., 2.1), 0.25);
    EXPECT_EQ(half(BoxRule::fixed, 2.1, 0.5), 0.5);
    EXPECT_EQ(half(BoxRule::fixed, 0.3, 2.), 0.1);
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
      core.points.data(core.points.stretch)[p] = stretch_x;
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
    // Fixed boxes do not use the stretch.
    shape.rule = BoxRule::fixed;
    EXPECT_EQ(count_clipped_boxes(core.points, core.grid, shape), 2u);
  }
} // namespace
