// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_problem_h
#define talus_equilibrium_static_problem_h

#include <talus/boundaries/boundaries.h>
#include <talus/contact/contact.h>
#include <talus/materials/materials.h>
#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

#include <functional>

namespace talus
{
  /// Soil to be brought to equilibrium, with all loads and boundaries at the
  /// time of the state. Points are sorted, and the nodes near points are
  /// active.
  template <int dim>
  struct StaticProblem
  {
    State<dim>           &state;
    const Transfer<dim>  &transfer;
    const Materials<dim> &materials;
    Boundaries<dim>      &boundaries;
    const Loads<dim>     &loads;
    Contact<dim>         &contact; ///< with obstacles
    /// Height of the mudline above or below a place, m; not a number where the
    /// vertical meets no soil. Empty if the mudline is unknown.
    std::function<double(const dealii::Point<dim> &)> mudline = {};
    /// Divides the strengths of soil and beds by a factor [-]; for strength
    /// reduction.
    std::function<void(double)> divide_strength = {};
  };



  /// Options of one search for equilibrium. Equilibrium::options() returns the
  /// parameters of section Equilibrium; strength reduction changes them.
  struct StaticOptions
  {
    unsigned int n_load_steps  = 1;    ///< number of equal load steps
    double       smallest_step = 1e-3; ///< smallest fraction of the load [-]
    double       allowed_imbalance = 1e-6; ///< limit for soil in balance [-]
    /// Whether to subtract the error of the weight (WellBalancedLoad).
    bool is_well_balanced = true;

    // Newton's method
    double tolerance = 1e-8; ///< relative residual [-]
    /// Relative residual that suffices for an update of the contact states [-];
    /// the states are updated again at the solution.
    double contact_tolerance = 0.;
    /// Distance by which facets of obstacles may give way in a load step, over
    /// the largest displacement [-].
    double       facet_tolerance       = 1e-5;
    unsigned int largest_contact_loops = 50; ///< in a load step [-]
    unsigned int largest_iterations    = 30;
    double       ghost_penalty         = 0.01; ///< gamma [-]
  };



  /// Compute mass, volume and force at the nodes as in the explicit scheme. The
  /// force is the imbalance before reactions of walls and seabed. Collective.
  template <int dim>
  inline void
  sum_forces(StaticProblem<dim> &problem)
  {
    State<dim> &state = problem.state;
    state.nodes.clear();
    state.points.for_each_batch([&](const Batch &batch) {
      state.workspace.reinit(batch.begin, batch.end);
      problem.transfer.apply_bbar_to_stress(state.points,
                                            state.workspace,
                                            batch);
      problem.transfer.scatter(state.with(problem.loads), batch);
    });
    state.nodes.sum_over_ranks(state.grid);
    problem.contact.find_soil(state);
    problem.boundaries.add_tractions(state.nodes,
                                     state.grid,
                                     state.time,
                                     state.constants.mass_cutoff);
  }
} // namespace talus

#endif
