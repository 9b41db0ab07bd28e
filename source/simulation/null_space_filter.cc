// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/null_space_filter.h>

#include <algorithm>
#include <array>
#include <vector>

namespace talus
{
  using namespace dealii;

  template <int dim>
  NullSpaceFilter<dim>::NullSpaceFilter()
    : ParameterAcceptor("/Transfer")
  {
    add_parameter(
      "Scheme",
      scheme_,
      "Update of the velocities of the points. 'FLIP': points add the "
      "increments of the grid, and velocities that the grid cannot see stay "
      "for ever. 'filtered FLIP': in addition, at a fixed interval, XPIC "
      "removes the velocities that the grid cannot see, and where B-bar is on "
      "the mean stress of each point is replaced by the cell mean.",
      this->prm,
      Patterns::Selection("FLIP|filtered FLIP"));
    add_parameter("Filter interval",
                  interval_,
                  "Number of steps between two filterings [-]. A smaller "
                  "number damps more; near 1/(CFL number) noise has no time to "
                  "grow in between.",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter(
      "Filter order",
      order_,
      "Number m of passes to the grid and back in XPIC(m) [-]. A larger number "
      "keeps more of the shortest waves; 1 is PIC.",
      this->prm,
      Patterns::Integer(1, 20));
  }



  namespace
  {
    /// Replace the mean stress of each point by the cell mean and keep the
    /// deviator. The first half of B-bar computes the shift. With B-bar the
    /// nodes feel the mean only, so nodal forces are unchanged; without B-bar
    /// the shift is zero.
    template <int dim>
    void
    filter_mean_stress(Points<dim>         &points,
                       StepWorkspace<dim>  &workspace,
                       const Transfer<dim> &transfer)
    {
      points.for_each_batch([&](const Batch &batch) {
        workspace.reinit(batch.begin, batch.end);
        transfer.apply_bbar_to_stress(points, workspace, batch);
        const double *const shift = workspace.mean_stress_shift();
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
    pass_to_grid_and_back(State<dim> &state, const Transfer<dim> &transfer)
    {
      // Forces are summed, too, but have no effect in a time step of length
      // zero.
      const double time_step = 0., flip_fraction = 0.;
      Loads<dim>   none;
      none.acceleration_of_body.resize(transfer.n_bodies());
      state.nodes.clear();
      state.points.for_each_batch([&](const Batch &batch) {
        state.workspace.reinit(batch.begin, batch.end);
        std::fill_n(state.workspace.mean_stress_shift(),
                    batch.end - batch.begin,
                    0.);
        transfer.scatter(
          state.points, state.workspace, batch, state.grid, none, state.nodes);
      });
      state.nodes.sum_over_ranks(state.grid);
      state.nodes.update_momentum(time_step, state.constants.mass_cutoff);
      state.nodes.share_with_ghosts(state.grid);
      // With zero time step and zero FLIP fraction only the velocities of the
      // points change: they become the velocity of the grid.
      state.points.for_each_batch([&](const Batch &batch) {
        state.workspace.reinit(batch.begin, batch.end);
        transfer.gather(state.nodes,
                        state.grid,
                        none,
                        state.points,
                        state.workspace,
                        batch,
                        time_step,
                        flip_fraction);
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
  // momentum.
  template <int dim>
  void
  NullSpaceFilter<dim>::apply(State<dim>          &state,
                              const Transfer<dim> &transfer) const
  {
    Points<dim> &points = state.points;
    filter_mean_stress(points, state.workspace, transfer);
    const unsigned int                   n = points.size();
    std::array<std::vector<double>, dim> unseen, seen;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double *const v = points.data(points.velocity, d);
        unseen[d].assign(v, v + n);
        seen[d].assign(n, 0.);
      }
    for (unsigned int pass = 0; pass < order_; ++pass)
      {
        pass_to_grid_and_back(state, transfer);
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



  template class NullSpaceFilter<2>;
  template class NullSpaceFilter<3>;
} // namespace talus
