// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_state_state_h
#define talus_state_state_h

#include <talus/base/works.h>
#include <talus/grid/nodal_fields.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/box_shape.h>
#include <talus/transfer/outflow.h>

namespace talus
{
  /// Where a simulation is: all that a step changes, for those who go on with
  /// it and for those who look at it. Points, works and counts are this rank's
  /// share; observers sum up. Between two steps the points are sorted, and the
  /// nodal fields are those of the step before (none at the start), which
  /// nothing depends on.
  template <int dim>
  struct State
  {
    explicit State(const MPI_Comm communicator)
      : grid(communicator)
    {}

    MPI_Comm
    communicator() const
    {
      return grid.communicator();
    }

    /// Add all but points and mesh, which checkpoints know, to the list.
    void
    list_state(StateList &list)
    {
      list.add("time", "s", time, Reduction::equal);
      list.add("time step", "s", time_step, Reduction::equal);
      list.add("step", "-", step, Reduction::equal);
      works.list_state(list);
      if (may_merge)
        list.add("merging work", "J", works.merging, Reduction::sum);
      outflow.list_state(list);
    }

    Points<dim>        points;
    StepWorkspace<dim> workspace; ///< of the phases of a step
    Grid<dim>          grid;
    NodalFields<dim>   nodes;
    BoxShape           box_shape;     ///< how the boxes of the points deform
    Works<dim>         works;         ///< so far
    Outflow<dim>       outflow;       ///< so far
    double             time      = 0; ///< s
    double             time_step = 0; ///< of the last step, s
    unsigned long      step      = 0; ///< number of steps so far
    bool               may_merge = false; ///< whether points are merged
    /// By body, mass of water that moves with the soil, as a share of that of
    /// the soil [-]; empty if water does nothing.
    std::vector<double> added_mass;
    double              mass_cutoff = 0; ///< nodes with less mass carry nothing, kg
  };
} // namespace talus

#endif
