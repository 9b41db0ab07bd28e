// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_state_state_h
#define talus_state_state_h

#include <talus/state/accounts.h>
#include <talus/transfer/box_shape.h>
#include <talus/transfer/outflow.h>
#include <talus/transfer/step_context.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace talus
{
  /// Constants of a run, which follow from parameters and initial mesh.
  template <int dim>
  struct RunConstants
  {
    BoxShape box_shape; ///< how the boxes of the points deform
    /// Faces whose nodes stay without increment: bit f for face f of the mesh.
    unsigned char held_faces = 0;
    /// Maximum mass of a node without momentum, kg.
    double mass_cutoff = 0;
    /// Mass of water that moves with the soil divided by the mass of the soil
    /// [-], by body; empty without added mass.
    std::vector<double> added_mass;
    /// Acceleration of gravity at full load, m/s^2.
    dealii::Tensor<1, dim> gravity;
  };



  /// State of a simulation: everything that a step changes. Points, accounts
  /// and counts are the share of this rank; observers sum over the ranks.
  /// Between two steps the points are sorted by cell. The nodal fields are left
  /// over from the previous step (none at the start), and no result depends on
  /// them.
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

    /// Data of a step under @p loads, for the transfer.
    StepContext<dim>
    with(const Loads<dim> &loads)
    {
      return {points, workspace, grid, loads, nodes};
    }

    /// Add everything except points and mesh, which a checkpoint stores
    /// separately.
    void
    list_state(StateList &list)
    {
      list.add("time", "s", time, Reduction::equal);
      list.add("time step", "s", time_step, Reduction::equal);
      list.add("step", "-", step, Reduction::equal);
      list.add("maximum path", "m", max_path, Reduction::equal);
      list.add("maximum velocity gradient",
               "1/s",
               max_velocity_gradient,
               Reduction::maximum);
      accounts.list_state(list);
      outflow.list_state(list);
    }

    Points<dim>        points;
    StepWorkspace<dim> workspace; ///< data between phases of a step
    Grid<dim>          grid;
    NodalFields<dim>   nodes;
    RunConstants<dim>  constants;     ///< set before the first step
    Accounts<dim>      accounts;      ///< energies and impulses
    Outflow<dim>       outflow;       ///< soil that left the mesh so far
    double             time      = 0; ///< s
    double             time_step = 0; ///< length of the last step, s
    unsigned long      step      = 0; ///< number of steps so far
    /// Sum over the steps of the time step times the maximum speed of the
    /// points, m. Between two steps no point moves farther than the difference,
    /// up to the difference between the speeds of point and grid.
    double max_path = 0;
    /// Maximum norm of the velocity gradient over the points of this rank in
    /// the last step, 1/s. Limits the next time step.
    double max_velocity_gradient = 0;
  };
} // namespace talus

#endif
