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
      "'FLIP': points take the increments of the grid, and keep for "
      "ever what the grid cannot see of their velocities. 'filtered "
      "FLIP': every some steps these velocities are taken away by "
      "XPIC, and differences of the mean stress within a cell with "
      "the cell mean on.",
      this->prm,
      Patterns::Selection("FLIP|filtered FLIP"));
    add_parameter("Filter interval",
                  interval_,
                  "Steps from one filtering to the next [-]. Less damps more; "
                  "near 1/(CFL number) noise has no time to grow between two.",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter(
      "Filter order",
      order_,
      "Number m of passes to the grid and back of XPIC(m) [-]: more "
      "keep more of the shortest waves. 1 is PIC.",
      this->prm,
      Patterns::Integer(1, 20));
  }



  namespace
  {
    /// The mean stress of the points becomes that of their cell; the deviator
    /// stays.
    /// By the first half of B-bar, which has the difference already. Where
    /// B-bar is on the nodes feel the mean only, so nodal forces stay as they
    /// are; where it is off the difference is zero, and so is the change.
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
        // Out of the plane, too: the deviator must not change.
        for (unsigned int d = 0; d < 3; ++d)
          {
            double *const stress = points.data(points.stress, d) + batch.begin;
            for (unsigned int k = 0; k < batch.end - batch.begin; ++k)
              stress[k] += shift[k];
          }
      });
    }



    /// Replace the velocities of the points by those that the grid has of them:
    /// one pass of XPIC, which is PIC.
    template <int dim>
    void
    pass_to_grid_and_back(State<dim> &state, const Transfer<dim> &transfer)
    {
      // Forces are summed up, too, but no time passes in which they could act.
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
      // With no time step and no share of FLIP nothing but the velocity of the
      // points changes, which becomes that of the grid.
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



  // XPIC(m): with P the pass to the grid and back, the new velocities are
  // (1 - (1 - P)^m) v = P v + P (1 - P) v + ..., so that the velocity column
  // holds in turn what no pass has seen so far. A mode that P leaves at its
  // share lambda is left at 1 - (1 - lambda)^m: the null space vanishes (lambda
  // = 0), and smooth motion, whose lambda is close to 1, stays.

  // The column of the velocities itself is what is passed on, since the kernels
  // read and write it: no second transfer that would have to be kept equal to
  // the first. It costs m passes over points and nodes, every some steps. Sums
  // and momentum are kept because each pass keeps them.
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
    // Nobody has moved; those that rest outside their cell were noted again.
    state.workspace.points_out_of_cell().clear();
  }



  template class NullSpaceFilter<2>;
  template class NullSpaceFilter<3>;
} // namespace talus
