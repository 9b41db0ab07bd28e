// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/points_kernel.h>
#include <talus/transfer/loads_kernel.h>
#include <talus/transfer/reference.h>
#include <talus/transfer/weights.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Acceleration of point @p p by weight and body force, m/s^2.
    template <int dim>
    Tensor<1, dim>
    acceleration_of_point(const Loads<dim>  &loads,
                          const unsigned int body,
                          const unsigned int p)
    {
      Tensor<1, dim> b;
      for (unsigned int d = 0; d < dim; ++d)
        b[d] = acceleration<double>(loads.view(body), p, d);
      return b;
    }



    /// Stress of point @p p in the dimensions of the mesh, Pa, with its mean
    /// averaged over the cell (B-bar).
    template <int dim>
    Tensor<2, dim>
    averaged_stress(const Points<dim>        &points,
                    const WorkspaceView<dim> &workspace,
                    const unsigned int        p)
    {
      const auto     s = load_stress<dim, double>(points, p);
      Tensor<2, dim> sigma;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          sigma[i][j] = s[stress_index<dim>(i, j)];
      for (unsigned int d = 0; d < dim; ++d)
        sigma[d][d] += workspace.mean_stress_shift()[p];
      return sigma;
    }
  } // namespace



  // Written to be read beside the formulas, not to be fast. The tests compare
  // the kernels with the functions below, so they share no optimization with
  // the kernels, only the functions that read stress and volume of a point.
  template <int dim>
  void
  scatter_by_definition(const StepContext<dim> &context,
                        const BoxShape         &shape,
                        const Segment          &segment,
                        NodeWeights<dim>       &room)
  {
    const Points<dim> &points = context.points;
    const auto workspace = context.workspace.view(segment.begin, segment.end);
    for (unsigned int p = segment.begin; p < segment.end; ++p)
      {
        // One list of weights for all nodes; it reuses the memory of the
        // previous point.
        weights_of_point(points, context.grid, shape, segment.cell, p, room);
        const double m  = points.data(points.mass)[p];
        const double V0 = points.data(points.reference_volume)[p];
        const double V  = volume_of_points<dim, double>(points, p);
        const auto   v  = load_vector(points, points.velocity, p);
        const auto   b  = acceleration_of_point(context.loads, segment.body, p);
        const auto   sigma = averaged_stress(points, workspace, p);
        // The stress is symmetric: sigma . grad S = grad S . sigma.
        for (const auto &w : room)
          context.nodes.add_sums(w.node,
                                 w.value * m,
                                 w.value * V0,
                                 w.value * m * v,
                                 w.value * m * b - V * sigma * w.gradient);
      }
  }



  // A node may be listed several times: the sum over entries is the sum over
  // nodes.
  template <int dim>
  MotionByDefinition<dim>
  interpolate_by_definition(const StepContext<dim> &context,
                            const BoxShape         &shape,
                            const unsigned int      cell,
                            const unsigned int      p,
                            NodeWeights<dim>       &room)
  {
    const NodalFields<dim> &nodes = context.nodes;
    weights_of_point(context.points, context.grid, shape, cell, p, room);
    MotionByDefinition<dim> there;
    for (const auto &w : room)
      {
        const auto v = nodes.velocity(w.node);
        there.velocity += w.value * v;
        there.increment += w.value * nodes.increment(w.node);
        // L_ij = dv_i/dx_j.
        there.gradient += outer_product(v, w.gradient);
      }
    return there;
  }



  // The power uses the mean velocity of the step, v - dv/2: only then is the
  // work of a constant force exact (doc/method.md, section 7).
  template <int dim>
  double
  gather_by_definition(const StepContext<dim> &context,
                       const BoxShape         &shape,
                       const Segment          &segment,
                       const double            dt,
                       const VelocityUpdate   &update)
  {
    Points<dim>     &points = context.points;
    const Cell<dim> &cell   = context.grid.cells()[segment.cell];
    const auto       work  = context.workspace.view(segment.begin, segment.end);
    double           power = 0;
    NodeWeights<dim> room;
    for (unsigned int p = segment.begin; p < segment.end; ++p)
      {
        const auto [v, dv, L] =
          interpolate_by_definition(context, shape, segment.cell, p, room);
        // Interpolation is complete: the point may move.
        bool is_inside = true;
        for (unsigned int i = 0; i < dim; ++i)
          {
            double &v_p = points.data(points.velocity, i)[p];
            double &x_p = points.data(points.position, i)[p];
            v_p         = update(v_p, v[i], dv[i]);
            x_p += dt * v[i];
            is_inside = is_inside && x_p >= cell.lower[i] &&
                        x_p < cell.lower[i] + cell.size;
            for (unsigned int d = 0; d < dim; ++d)
              work.velocity_gradient(i, d)[p] = L[i][d];
          }
        if (!is_inside)
          context.workspace.points_out_of_cell().push_back(p);
        power += points.data(points.mass)[p] *
                 (acceleration_of_point(context.loads, segment.body, p) *
                  (v - 0.5 * dv));
      }
    return power;
  }



  template decltype(scatter_by_definition<2>)     scatter_by_definition<2>;
  template decltype(scatter_by_definition<3>)     scatter_by_definition<3>;
  template decltype(interpolate_by_definition<2>) interpolate_by_definition<2>;
  template decltype(interpolate_by_definition<3>) interpolate_by_definition<3>;
  template decltype(gather_by_definition<2>)      gather_by_definition<2>;
  template decltype(gather_by_definition<3>)      gather_by_definition<3>;
} // namespace talus
