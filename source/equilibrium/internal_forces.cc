// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/internal_forces.h>
#include <talus/points/points_kernel.h>

namespace talus
{
  using namespace dealii;

  /// H = sum_i u_i (x) grad S_i replaces the velocity gradient in the
  /// workspace, with a step of length 1, so the kernels of B-bar and laws serve
  /// both dynamics and statics. The weights are fixed at the start of the load
  /// step: H is linear in u, and the derivative of the forces has no
  /// contribution from the weights.
  template <int dim>
  void
  InternalForces<dim>::set_gradients(StaticProblem<dim>            &problem,
                                     const ShapeFunctionCache<dim> &weights,
                                     const std::vector<double>     &u) const
  {
    Points<dim> &points = problem.state.points;
    problem.state.workspace.reinit(0, points.size());
    for (unsigned int c = 0; c < weights.cells().size(); ++c)
      {
        const Batch &cell  = weights.cells()[c];
        const auto   patch = weights.patch(c);
        for (unsigned int p = cell.begin; p < cell.end; ++p)
          {
            const auto    *weight = weights.of_point(c, p - cell.begin);
            Tensor<2, dim> H;
            for (unsigned int a = 0; a < patch.n_nodes; ++a)
              for (unsigned int i = 0; i < dim; ++i)
                H[i] += u[dim * patch.nodes[a] + i] * weight[a].gradient;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                problem.state.workspace.velocity_gradient(i, j)[p] = H[i][j];
          }
      }
    problem.transfer.apply_bbar_to_dilatation(points,
                                              problem.state.workspace,
                                              points.all());
  }



  /// First evaluate stress and tangent by the laws, for ranges of points of the
  /// same material; laws return the effective stress, forces follow from the
  /// total stress. Then add the forces cell by cell, as the mean of B-bar
  /// couples all points of a cell, also of different bodies. The tangent is
  /// kept for add_tangent(): laws return stress and tangent together (by
  /// numbers that carry derivatives), so there is no second pass and no
  /// inconsistency.
  template <int dim>
  void
  InternalForces<dim>::evaluate(StaticProblem<dim>            &problem,
                                const ShapeFunctionCache<dim> &weights,
                                const std::vector<double>     &u,
                                std::vector<double>           &forces)
  {
    Points<dim> &points = problem.state.points;
    set_gradients(problem, weights, u);
    linearizations_.resize(points.size());
    problem.materials.set_cell_sizes(
      points, points.all(), [&](const unsigned int cell) {
        return problem.state.grid.cells()[cell].size;
      });
    problem.materials.for_each_material_range(
      points,
      points.all(),
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        model.linearize(points,
                        problem.state.workspace,
                        begin,
                        end,
                        linearizations_.data() + begin);
        if (points.have_pore_pressure())
          model.pore_water().linearize(points,
                                       problem.state.workspace,
                                       begin,
                                       end,
                                       linearizations_.data() + begin);
      });
    find_volumes(problem);
    for (unsigned int c = 0; c < weights.cells().size(); ++c)
      add_forces_of_cell(c, weights, forces);
  }



  /// Compute the volumes. In volumes_of_mean_, zero marks points without B-bar.
  template <int dim>
  void
  InternalForces<dim>::find_volumes(const StaticProblem<dim> &problem)
  {
    const Points<dim> &points = problem.state.points;
    volumes_.resize(points.size());
    volumes_of_mean_.resize(points.size());
    points.for_each_point([&](const Segment &segment, const unsigned int p) {
      volumes_[p] = volume_of_points<dim, double>(points, p);
      volumes_of_mean_[p] =
        problem.transfer.uses_bbar(segment.body) ? volumes_[p] : 0.;
    });
  }



  template <int dim>
  void
  InternalForces<dim>::add_forces_of_pressure(
    const StaticProblem<dim>      &problem,
    const ShapeFunctionCache<dim> &weights,
    const std::vector<double>     &pressure,
    std::vector<double>           &forces)
  {
    find_volumes(problem);
    linearizations_.resize(pressure.size());
    for (std::size_t p = 0; p < pressure.size(); ++p)
      {
        linearizations_[p].stress = {};
        for (unsigned int d = 0; d < dim; ++d)
          linearizations_[p].stress[(dim + 1) * d] = -pressure[p];
      }
    for (unsigned int c = 0; c < weights.cells().size(); ++c)
      add_forces_of_cell(c, weights, forces);
  }



  /// Add f_i += sum_p V (P + (qm - q) I) grad S_ip, the derivative of V P : H'
  /// by u (doc/method.md, sections 3 and 12). Here q is the mean of the dim
  /// normal components in the plane, and qm the mean of q over the cell,
  /// weighted by volume. With the pressure instead of q the two halves of B-bar
  /// would not be adjoint, and add_tangent() would not give the derivative of
  /// the forces.
  template <int dim>
  void
  InternalForces<dim>::add_forces_of_cell(
    const unsigned int             c,
    const ShapeFunctionCache<dim> &weights,
    std::vector<double>           &forces) const
  {
    const Batch &cell = weights.cells()[c];
    const auto   q    = [this](const unsigned int p) {
      double sum = 0;
      for (unsigned int i = 0; i < dim; ++i)
        sum += linearizations_[p].stress[(dim + 1) * i];
      return sum / dim;
    };
    double sum = 0, volume = 0;
    for (unsigned int p = cell.begin; p < cell.end; ++p)
      {
        sum += volumes_of_mean_[p] * q(p);
        volume += volumes_of_mean_[p];
      }
    const double mean  = (volume > 0. ? sum / volume : 0.);
    const auto   patch = weights.patch(c);
    for (unsigned int p = cell.begin; p < cell.end; ++p)
      {
        const auto  *weight = weights.of_point(c, p - cell.begin);
        const double shift  = (volumes_of_mean_[p] > 0. ? mean - q(p) : 0.);
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            {
              double sum = shift * weight[a].gradient[i];
              for (unsigned int j = 0; j < dim; ++j)
                sum += linearizations_[p].stress[dim * i + j] *
                       weight[a].gradient[j];
              forces[dim * patch.nodes[a] + i] += volumes_[p] * sum;
            }
      }
  }



  /// Compute the mean of the weight gradients at the nodes of cell @p c, 1/m,
  /// over the points with B-bar: the rate of volume change of the cell as a
  /// linear form. Through this part of B, a point is coupled with nodes outside
  /// its own box.
  template <int dim>
  void
  InternalForces<dim>::set_mean_gradient(const unsigned int             c,
                                         const ShapeFunctionCache<dim> &weights,
                                         Scratch &scratch) const
  {
    const Batch &cell  = weights.cells()[c];
    const auto   patch = weights.patch(c);
    scratch.mean_gradient.assign(patch.n_nodes, Tensor<1, dim>());
    double volume = 0;
    for (unsigned int p = cell.begin; p < cell.end; ++p)
      {
        volume += volumes_of_mean_[p];
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          scratch.mean_gradient[a] +=
            volumes_of_mean_[p] *
            weights.of_point(c, p - cell.begin)[a].gradient;
      }
    if (volume > 0.)
      for (auto &gradient : scratch.mean_gradient)
        gradient /= volume;
  }



  /// Compute B: row k gives component k of the displacement gradient of a
  /// point, after the mean, as a linear form of the displacements of the patch.
  /// Row (i, j) has dS_a/dx_j at component i of node a. With B-bar, the rows of
  /// the normal components also have (mean - own)/dim of the divergence, as D'
  /// in doc/method.md, section 3.
  template <int dim>
  void
  InternalForces<dim>::fill_strain(
    const typename ShapeFunctionCache<dim>::Weight *weight,
    const unsigned int                              n_nodes,
    const bool                                      uses_mean,
    Scratch                                        &scratch) const
  {
    const unsigned int n = dim * n_nodes;
    scratch.strain.assign(n_gradients * n, 0.);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int i = 0; i < dim; ++i)
        {
          for (unsigned int j = 0; j < dim; ++j)
            scratch.strain[(dim * i + j) * n + dim * a + i] =
              weight[a].gradient[j];
          if (uses_mean)
            for (unsigned int k = 0; k < dim; ++k)
              scratch.strain[(dim + 1) * k * n + dim * a + i] +=
                (scratch.mean_gradient[a][i] - weight[a].gradient[i]) / dim;
        }
  }



  /// Add B^T V A B of one point. Two products, V A B and then B^T times the
  /// result, need dim^4 n + dim^2 n^2 multiplications instead of dim^4 n^2. The
  /// inner loops run over contiguous rows.
  template <int dim>
  void
  InternalForces<dim>::add_point(const double              volume,
                                 const StressTangent<dim> &linearization,
                                 const unsigned int        n,
                                 Scratch                  &scratch) const
  {
    scratch.stressed.assign(n_gradients * n, 0.);
    for (unsigned int k = 0; k < n_gradients; ++k)
      for (unsigned int l = 0; l < n_gradients; ++l)
        {
          const double  A    = volume * linearization.tangent[k][l];
          const double *from = &scratch.strain[l * n];
          double       *to   = &scratch.stressed[k * n];
          for (unsigned int b = 0; b < n; ++b)
            to[b] += A * from[b];
        }
    for (unsigned int k = 0; k < n_gradients; ++k)
      for (unsigned int a = 0; a < n; ++a)
        {
          const double B = scratch.strain[k * n + a];
          // Without the mean only each dim-th entry of a row is nonzero.
          if (B == 0.)
            continue;
          const double *from = &scratch.stressed[k * n];
          double       *to   = &scratch.matrix(a, 0);
          for (unsigned int b = 0; b < n; ++b)
            to[b] += B * from[b];
        }
  }



  /// One element matrix per cell, over all nodes touched by any of its points.
  /// With B-bar all nodes of a cell are coupled anyway, and one matrix per
  /// point would need several times as many insertions. The matrix is symmetric
  /// if the tangents of the laws are symmetric.
  template <int dim>
  void
  InternalForces<dim>::add_tangent(const ShapeFunctionCache<dim> &weights,
                                   StiffnessMatrix<dim>          &matrix) const
  {
    Scratch scratch;
    for (unsigned int c = 0; c < weights.cells().size(); ++c)
      {
        const Batch       &cell  = weights.cells()[c];
        const auto         patch = weights.patch(c);
        const unsigned int n     = dim * patch.n_nodes;
        set_mean_gradient(c, weights, scratch);
        scratch.matrix.reinit(n, n);
        for (unsigned int p = cell.begin; p < cell.end; ++p)
          {
            fill_strain(weights.of_point(c, p - cell.begin),
                        patch.n_nodes,
                        volumes_of_mean_[p] > 0.,
                        scratch);
            add_point(volumes_[p], linearizations_[p], n, scratch);
          }
        matrix.add(weights.nodes(c), scratch.matrix);
      }
  }



  template class InternalForces<2>;
  template class InternalForces<3>;
} // namespace talus
