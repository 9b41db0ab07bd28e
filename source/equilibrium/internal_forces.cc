// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/internal_forces.h>
#include <talus/points/points_kernel.h>

namespace talus
{
  using namespace dealii;

  /// H = sum_i u_i (x) grad S_i goes into the columns of the workspace in which
  /// the dynamics has the velocity gradient, here with a step of length 1:
  /// kernels of B-bar and laws then serve both. The weights are those of the
  /// beginning of the load step, so H is linear in u, and the derivative of the
  /// forces has no part from the weights.
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



  /// Stress and tangent first, by the laws, over ranges of points of one
  /// material; then the forces, cell by cell, as the mean of B-bar couples the
  /// points of a cell, of whatever body. The tangent is kept for add_tangent():
  /// laws give both at once (numbers that carry their derivatives), so that no
  /// second pass over them is needed and the two cannot disagree.
  template <int dim>
  bool
  InternalForces<dim>::evaluate(StaticProblem<dim>            &problem,
                                const ShapeFunctionCache<dim> &weights,
                                const std::vector<double>     &u,
                                std::vector<double>           &forces)
  {
    Points<dim> &points = problem.state.points;
    set_gradients(problem, weights, u);
    linearizations_.resize(points.size());
    bool sound = true;
    problem.materials.for_each_material_range(
      points,
      points.all(),
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        sound = sound && model.linearize(points,
                                         problem.state.workspace,
                                         begin,
                                         end,
                                         measure_,
                                         linearizations_.data() + begin);
      });
    // Nothing was added so far, so the caller may try a shorter step.
    if (!sound)
      return false;
    find_volumes(problem);
    for (unsigned int c = 0; c < weights.cells().size(); ++c)
      add_forces_of_cell(c, weights, forces);
    return true;
  }



  /// Volumes at the start of the load step: F is changed in commit() only. Zero
  /// marks the points that neither give to the mean of B-bar nor take it.
  template <int dim>
  void
  InternalForces<dim>::find_volumes(const StaticProblem<dim> &problem)
  {
    const Points<dim> &points = problem.state.points;
    volumes_.resize(points.size());
    volumes_of_mean_.resize(points.size());
    for (const Segment &segment : points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          volumes_[p] =
            points.data(points.reference_volume)[p] *
            determinant(
              load_matrix<dim, double>(points, points.deformation_gradient, p));
          volumes_of_mean_[p] =
            problem.transfer.uses_bbar(segment.body) ? volumes_[p] : 0.;
        }
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



  /// f_i += sum_p V (P + (qm - q) I) grad S_ip, with q the mean of the dim
  /// normal components in the plane and qm its mean over the cell, weighted by
  /// volumes: the derivative of V P : H' by u (doc/method.md, sections 3 and
  /// 12). With the pressure in place of q the two halves of B-bar would not be
  /// adjoint, and the tangent below would not be the derivative of these
  /// forces.
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



  /// The mean over the points of a cell that take it of the gradients at its
  /// nodes: the rate of volume change of the cell, as a linear form.
  /// It is the part of B that couples each point with nodes that its own box
  /// does not touch.
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



  /// Row k of B: displacement gradient k of a point, after the mean, as a linear
  /// form of the displacements of the patch.
  /// Row (i, j) has dS_a/dx_j at component i of node a. With B-bar the rows of
  /// the normal components get (mean - own)/dim of the divergence besides, as
  /// D' in doc/method.md, section 3.
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



  /// B^T V A B of one point.
  /// In two products, V A B and then its product with B^T: dim^4 n + dim^2 n^2
  /// multiplications in place of dim^4 n^2. The inner loops run over rows that
  /// lie in one piece.
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
          // Without the mean only each dim-th entry of a row is not zero.
          if (B == 0.)
            continue;
          const double *from = &scratch.stressed[k * n];
          double       *to   = &scratch.matrix(a, 0);
          for (unsigned int b = 0; b < n; ++b)
            to[b] += B * from[b];
        }
  }



  /// One element matrix per cell, over all nodes that any of its points
  /// touches: with B-bar all of these are coupled anyway, and one per point
  /// would be some times as many insertions into the sparse matrix. It is
  /// symmetric where the tangents of the laws are. The constraints drop rows
  /// and columns of held unknowns and leave a number on their diagonal.
  template <int dim>
  void
  InternalForces<dim>::add_tangent(const ShapeFunctionCache<dim>  &weights,
                                   const Unknowns<dim>            &unknowns,
                                   TrilinosWrappers::SparseMatrix &matrix) const
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
        scratch.unknowns.clear();
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            scratch.unknowns.push_back(unknowns.first(patch.nodes[a]) + i);
        unknowns.constraints().distribute_local_to_global(scratch.matrix,
                                                          scratch.unknowns,
                                                          matrix);
      }
  }



  template class InternalForces<2>;
  template class InternalForces<3>;
} // namespace talus
