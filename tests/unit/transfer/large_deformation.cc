// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/box_rule.h>
#include <talus/transfer/large_deformation.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Tensor;

  // More than a register of any machine holds, and a rest.
  constexpr unsigned int n_deformed = 27;

  /// Deformation gradient with the determinant @p J whose longest axis is about
  /// @p length: a random one, sheared.
  template <int dim>
  Tensor<2, dim>
  sheared(Core<dim> &core, const double length, const double J)
  {
    Tensor<2, dim> R;
    do
      R = core.tensor(-1., 1.);
    while (std::abs(determinant(R)) < 0.1);
    R                    = dealii::project_onto_orthogonal_tensors(R);
    Tensor<2, dim> shear = dealii::unit_symmetric_tensor<dim>();
    shear[0][1]          = length;
    shear[dim - 1][dim - 1] *= J;
    return R * shear * transpose(R);
  }



  /// Edges of the boxes and what the splitter compares.
  template <int dim>
  std::vector<double>
  boxes(Core<dim> &core, const BoxRule rule)
  {
    auto &points = core.points;
    update_stretch(points, core.workspace, 0, n_deformed, rule, 0.);
    std::vector<double> result;
    for (unsigned int p = 0; p < n_deformed; ++p)
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.push_back(edge_of_box(points, rule, d, p).norm());
          result.push_back(points.data(points.stretch, d)[p] /
                           points.data(points.creation_stretch, d)[p]);
        }
    return result;
  }



  template <int dim>
  void
  expect_renewed(const BoxRule rule)
  {
    Core<dim> core(cube<dim>());
    auto     &points = core.points;
    points.append(n_deformed);
    core.workspace.reinit(0, n_deformed);
    std::vector<Tensor<2, dim>> F(n_deformed);
    for (unsigned int p = 0; p < n_deformed; ++p)
      {
        // Every third one is to stay as it is.
        F[p] = sheared(core, p % 3 == 0 ? 900. : 1100. + 50. * p, 0.9);
        core.set_deformation(p, F[p]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            points.data(points.reference_length, d)[p] = 0.1 + 0.01 * p;
            points.data(points.stretch, d)[p]          = 1.5;
            points.data(points.creation_stretch, d)[p] = 1. + d;
          }
      }
    const std::vector<double> before = boxes(core, rule);
    renew_large_deformations(points, 0, n_deformed, rule);
    const std::vector<double> after = boxes(core, rule);
    for (unsigned int i = 0; i < before.size(); ++i)
      EXPECT_NEAR(after[i], before[i], 1e-7 * before[i]);
    for (unsigned int p = 0; p < n_deformed; ++p)
      {
        const Tensor<2, dim> now = core.deformation(p);
        if (F[p].norm() <= 1000.)
          {
            EXPECT_EQ((now - F[p]).norm(), 0.);
            continue;
          }
        EXPECT_NEAR(now.norm(), 500., 1.);
        // The volume that F was made with, but for the round-off of its
        // entries.
        EXPECT_NEAR(determinant(now), 0.9, 4e-15 * F[p].norm_square());
        // M = now F^-1 is symmetric: it does not turn the material.
        const Tensor<2, dim> M = now * invert(F[p]);
        EXPECT_LT((M - transpose(M)).norm(), 1e-6 * M.norm());
      }
  }
} // namespace



// Volume, boxes and the splitter's criterion stay when F begins anew.
TEST(LargeDeformation, BeginsAnew)
{
  for (const BoxRule rule : {BoxRule::fixed,
                             BoxRule::deformation_gradient,
                             BoxRule::right_stretch,
                             BoxRule::left_stretch,
                             BoxRule::convected_domain})
    {
      SCOPED_TRACE(static_cast<int>(rule));
      expect_renewed<2>(rule);
      expect_renewed<3>(rule);
    }
}



// Simple shear at constant volume, a long way: without renewal det F is lost.
TEST(LargeDeformation, VolumeKeepsItsDigits)
{
  Core<2> core(cube<2>());
  auto   &points = core.points;
  points.append(1);
  Tensor<2, 2> step;
  // Pure shear whose axes turn against the material, so that F grows in all.
  const double e = std::exp(0.01);
  step[0][0]     = e;
  step[1][1]     = 1. / e;
  Tensor<2, 2> F = dealii::unit_symmetric_tensor<2>(), whole = F;
  for (unsigned int i = 0; i < 3000; ++i)
    {
      const double       angle = 1e-3;
      const Tensor<2, 2> R({{std::cos(angle), -std::sin(angle)},
                            {std::sin(angle), std::cos(angle)}});
      whole = R * step * whole;
      core.set_deformation(0, R * step * core.deformation(0));
      if (i == 0)
        core.set_deformation(0, R * step);
      renew_large_deformations(points, 0, 1, BoxRule::fixed);
    }
  EXPECT_GT(std::abs(determinant(whole) - 1.), 1e-2);
  EXPECT_NEAR(determinant(core.deformation(0)), 1., 1e-7);
}
