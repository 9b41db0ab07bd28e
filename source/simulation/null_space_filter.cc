// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/null_space_filter.h>

#include <algorithm>
#include <array>
#include <vector>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Replace the mean stress of each point by the cell mean and keep the
    /// deviator. The first half of B-bar computes the shift. With B-bar the
    /// nodes feel the mean only, so nodal forces are unchanged; without B-bar
    /// nothing is replaced. With an excess pore pressure u the total stress
    /// gets the mean, and the shift contains -u. In undrained soil the water,
    /// the stiffer part, takes the change as far as it does not cavitate: in
    /// the effective stress it would be strength, kept by liquefied soil, which
    /// bears no tension.
    template <int dim>
    void
    filter_mean_stress(Points<dim>          &points,
                       const Materials<dim> &materials,
                       StepWorkspace<dim>   &workspace,
                       const Transfer<dim>  &transfer)
    {
      points.for_each_batch([&](const Batch &batch) {
        workspace.reinit(batch.begin, batch.end);
        transfer.apply_bbar_to_stress(points, workspace, batch);
        double *const shift = workspace.mean_stress_shift();
        if (points.have_pore_pressure())
          materials.for_each_material_range(
            points,
            batch,
            [&](const MaterialModel<dim> &model,
                const unsigned int        begin,
                const unsigned int        end) {
              const WaterResponse<dim> water = model.pore_water();
              double *const            u = points.data(points.pore_pressure());
              for (unsigned int p = begin; p < end; ++p)
                {
                  double &of_point = shift[p - batch.begin];
                  if (water.stiffness > 0.)
                    u[p] = std::max(-of_point, -water.largest_suction);
                  of_point += u[p];
                }
            });
        // Shift all three normal stresses, also in 2-D: the deviator must not
        // change.
        for (unsigned int d = 0; d < 3; ++d)
          {
            double *const stress = points.data(points.stress, d) + batch.begin;
            for (unsigned int k = 0; k < batch.end - batch.begin; ++k)
              stress[k] += shift[k];
          }
      });
    }



    /// Replace the velocities of the points by the velocity of the grid
    /// interpolated to them: one pass of XPIC, identical to PIC.
    template <int dim>
    void
    pass_to_grid_and_back(State<dim>            &state,
                          const Transfer<dim>   &transfer,
                          Boundaries<dim> *const boundaries,
                          const bool             is_last)
    {
      // Forces are summed, too, but have no effect in a time step of length
      // zero.
      const double time_step = 0.;
      Loads<dim>   none;
      none.acceleration_of_body.resize(transfer.n_bodies());
      const StepContext<dim> context = state.with(none);
      state.nodes.clear();
      state.points.for_each_batch([&](const Batch &batch) {
        state.workspace.reinit(batch.begin, batch.end);
        std::fill_n(state.workspace.mean_stress_shift(),
                    batch.end - batch.begin,
                    0.);
        transfer.scatter(context, batch);
      });
      state.nodes.sum_over_ranks(state.grid);
      state.nodes.update_momentum(time_step, state.constants.mass_cutoff);
      if (boundaries)
        boundaries->hold_nodes(state, is_last);
      state.nodes.share_with_ghosts(state.grid);
      // Only the velocities of the points change.
      state.points.for_each_batch([&](const Batch &batch) {
        state.workspace.reinit(batch.begin, batch.end);
        transfer.gather(context, batch, time_step, pic);
      });
    }
  } // namespace



  // XPIC(m): with P a pass to the grid and back, the new velocities are
  // (1 - (1 - P)^m) v = P v + P (1 - P) v + ..., so the velocity column holds
  // in turn the part of v that no pass has seen. A mode with eigenvalue lambda
  // of P is multiplied by 1 - (1 - lambda)^m: the null space (lambda = 0)
  // vanishes, and smooth motion (lambda close to 1) stays.

  // The velocity column itself is passed on, since the kernels read and write
  // it; a second transfer would have to be kept equal to the first. The cost is
  // m passes over points and nodes per filtering. Each pass conserves mass and
  // momentum up to the impulse J of held nodes. With J_k of pass k the parts
  // seen sum to the momentum of v plus J_1 + (J_2 - J_1) + ... = J_m: only the
  // last pass is recorded.
  template <int dim>
  void
  filter_null_space(State<dim>            &state,
                    const Materials<dim>  &materials,
                    const Transfer<dim>   &transfer,
                    Boundaries<dim> *const boundaries)
  {
    Points<dim> &points = state.points;
    filter_mean_stress(points, materials, state.workspace, transfer);
    const unsigned int                   n = points.size();
    std::array<std::vector<double>, dim> unseen, seen;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double *const v = points.data(points.velocity, d);
        unseen[d].assign(v, v + n);
        seen[d].assign(n, 0.);
      }
    const unsigned int order = transfer.scheme().filter_order();
    for (unsigned int pass = 0; pass < order; ++pass)
      {
        pass_to_grid_and_back(state, transfer, boundaries, pass + 1 == order);
        for (unsigned int d = 0; d < dim; ++d)
          {
            double *const v = points.data(points.velocity, d);
            for (unsigned int p = 0; p < n; ++p)
              {
                seen[d][p] += v[p];
                unseen[d][p] -= v[p];
                v[p] = unseen[d][p];
              }
          }
      }
    for (unsigned int d = 0; d < dim; ++d)
      std::copy(seen[d].begin(),
                seen[d].end(),
                points.data(points.velocity, d));
    // No point has moved; points resting outside of their cell were listed
    // again.
    state.workspace.points_out_of_cell().clear();
  }



  template decltype(filter_null_space<2>) filter_null_space<2>;
  template decltype(filter_null_space<3>) filter_null_space<3>;
} // namespace talus
