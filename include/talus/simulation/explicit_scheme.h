// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_explicit_scheme_h
#define talus_simulation_explicit_scheme_h

#include <talus/adaptivity/merger.h>
#include <talus/adaptivity/splitter.h>
#include <talus/base/phase_timer.h>
#include <talus/contact/point_confinement.h>
#include <talus/problem/problem.h>
#include <talus/simulation/background_mesh.h>
#include <talus/simulation/inflow.h>
#include <talus/simulation/step_agreement.h>
#include <talus/simulation/time_step.h>
#include <talus/state/state.h>
#include <talus/transfer/group_memory.h>
#include <talus/transfer/transfer.h>

#include <string>

namespace talus
{
  /// Explicit material point method: generalized interpolation,
  /// update-stress-last scheme, and split of points stretched too far.
  /// @cite bardenhagen2002, @cite esub
  template <int dim>
  class ExplicitScheme
  {
  public:
    ExplicitScheme(State<dim>          &state,
                   Problem<dim>        &problem,
                   const Transfer<dim> &transfer,
                   BackgroundMesh<dim> &mesh,
                   PhaseTimer          &timer);

    /// Advance by one step, at most to @p end_time, s. @p own is the request of
    /// this rank for the time after the step; return the maximum over all
    /// ranks. Collective.
    RunRequest
    advance(double end_time, RunRequest own);

    /// Return the stable time step of the present state, s, minimum over the
    /// points of all ranks. Collective.
    double
    stable_time_step();

    /// Throw ExcUser if a run to @p end_time, s, would take too many steps to
    /// end, or if there are more points than the splitter allows. Collective.
    void
    check_effort(double end_time);

    /// Return a sentence with time, stable time step, and limiting condition.
    /// Collective.
    std::string
    description();

    const Splitter<dim> &
    splitter() const
    {
      return splitter_;
    }

    Splitter<dim> &
    splitter()
    {
      return splitter_;
    }

    const Merger<dim> &
    merger() const
    {
      return merger_;
    }

    Merger<dim> &
    merger()
    {
      return merger_;
    }

    Inflow<dim> &
    inflow()
    {
      return inflow_;
    }

  private:
    void
    merge();
    void
    filter();
    void
    points_to_grid();
    RunRequest
    agree_on_step(double end_time, RunRequest own);
    void
    update_nodes();
    void
    grid_to_points();
    void
    change_pore_pressure();
    void
    reduce_edges(const Batch &batch);
    void
    split();

    State<dim>           &state_;
    Problem<dim>         &problem_;
    const Transfer<dim>  &transfer_;
    BackgroundMesh<dim>  &mesh_;
    PhaseTimer           &timer_;
    PointConfinement<dim> confinement_;
    Splitter<dim>         splitter_;
    Merger<dim>           merger_;
    Inflow<dim>           inflow_;
    TimeStep<dim>         time_step_;
    GroupMemory<dim>      groups_; ///< scratch memory of a step
    StepAgreement         agreement_;
  };
} // namespace talus

#endif
