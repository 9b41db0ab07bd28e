// SPDX-License-Identifier: LGPL-2.1-or-later
#include <set>

#include "transfer_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  // ------------------------------------------------------------ adjoint pairs

  template <int dim>
  double
  contraction(const Tensor<2, dim> &A, const Tensor<2, dim> &B)
  {
    return dealii::scalar_product(A, B);
  }



  /// The power of the internal forces at the nodes is that of the stress at
  /// the points: sum f_i . v_i = - sum V sigma' : grad v.
  template <int dim>
  void
  expect_adjoint_kernels(Core<dim> &core)
  {
    core.loads.varies = false;
    for (auto &acceleration : core.loads.acceleration_of_body)
      acceleration = Tensor<1, dim>();
    const auto                sums  = core.scatter();
    const double             *shift = core.workspace.mean_stress_shift();
    const std::vector<double> mean_stress_shift(shift,
                                                shift + core.points.size());
    for (unsigned int n = 0; n < core.grid.n_nodes(); ++n)
      core.nodes.set_motion(n, core.vector(-1., 1.), core.vector(-1., 1.));
    core.nodes.share_with_ghosts(core.grid);
    double of_nodes = 0, of_points = 0, scale = 0;
    for (unsigned int n = 0; n < core.grid.n_nodes(); ++n)
      for (unsigned int d = 0; d < dim; ++d)
        of_nodes +=
          sums[n][SumIndex<dim>::force + d] * core.nodes.velocity(n)[d];
    core.gather(0.1);
    for (unsigned int p = 0; p < core.points.size(); ++p)
      {
        Tensor<2, dim> sigma = core.stress(p);
        for (unsigned int d = 0; d < dim; ++d)
          sigma[d][d] += mean_stress_shift[p];
        const double power =
          core.volume(p) * contraction(sigma, core.velocity_gradient(p));
        of_points -= power;
        scale += std::abs(power);
      }
    EXPECT_NEAR(of_nodes, of_points, 1e-13 * scale);
  }



  TEST(Transfer, KernelsAreAdjoint)
  {
    on_both_meshes<2>("", expect_adjoint_kernels<2>);
    on_both_meshes<3>("", expect_adjoint_kernels<3>);
  }



  template <int dim>
  void
  expect_adjoint_means(Core<dim> &core)
  {
    auto &points    = core.points;
    auto &workspace = core.workspace;
    workspace.reinit(0, points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          workspace.velocity_gradient(i, j)[p] = core.number(-1., 1.);
    std::vector<Tensor<2, dim>> old;
    for (unsigned int p = 0; p < points.size(); ++p)
      old.push_back(core.velocity_gradient(p));
    core.transfer.apply_bbar_to_stress(points, workspace, points.all());
    core.transfer.apply_bbar_to_dilatation(points, workspace, points.all());

    double rate_averaged = 0, stress_averaged = 0, scale = 0, change = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double V     = core.volume(p);
        auto         sigma = core.stress(p);
        const auto   L     = core.velocity_gradient(p);
        rate_averaged += V * contraction(sigma, L);
        for (unsigned int d = 0; d < dim; ++d)
          sigma[d][d] += core.workspace.mean_stress_shift()[p];
        stress_averaged += V * contraction(sigma, old[p]);
        scale += V * std::abs(contraction(sigma, old[p]));
        change += V * std::abs(trace(L - old[p]));
        // The deviator is not touched, nor is a body without the mean.
        const auto difference = L - old[p];
        EXPECT_LT(deviator(symmetrize(difference)).norm(), 1e-14);
        if (points.data(points.body)[p] == 1.)
          {
            EXPECT_EQ(difference.norm(), 0.);
            EXPECT_EQ(workspace.mean_stress_shift()[p], 0.);
          }
      }
    EXPECT_GT(change, 1.);
    EXPECT_NEAR(rate_averaged, stress_averaged, 1e-13 * scale);
  }



  /// Within a cell, the points of all bodies with the mean have one rate of
  /// volume change and one mean stress: those weighted with the volumes.
  template <int dim>
  void
  expect_means(Core<dim> &core)
  {
    expect_adjoint_means(core);
    auto        &points       = core.points;
    unsigned int n_of_several = 0;
    points.for_each_cell(points.all(), [&](const Batch &cell) {
      std::vector<unsigned int> with_mean;
      std::set<double>          bodies;
      double                    mean_q = 0, volume = 0;
      for (unsigned int p = cell.begin; p < cell.end; ++p)
        if (points.data(points.body)[p] != 1.)
          {
            with_mean.push_back(p);
            bodies.insert(points.data(points.body)[p]);
            mean_q += core.volume(p) * trace(core.stress(p)) / dim;
            volume += core.volume(p);
          }
      n_of_several += bodies.size() > 1;
      for (const unsigned int p : with_mean)
        {
          EXPECT_NEAR(trace(core.stress(p)) / dim +
                        core.workspace.mean_stress_shift()[p],
                      mean_q / volume,
                      1e-12);
          EXPECT_NEAR(trace(core.velocity_gradient(p)),
                      trace(core.velocity_gradient(with_mean[0])),
                      1e-14);
        }
    });
    EXPECT_GT(n_of_several, 5u);
  }



  TEST(Transfer, CellMeansAreAdjoint)
  {
    on_both_meshes<2>("", expect_means<2>);
    on_both_meshes<3>("", expect_means<3>);
  }
} // namespace
