// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_step_context_h
#define talus_transfer_step_context_h

#include <talus/grid/nodal_fields.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/loads.h>

namespace talus
{
  /// Data of a step that the transfer reads and writes.
  template <int dim>
  struct StepContext
  {
    Points<dim>        &points;
    StepWorkspace<dim> &workspace; ///< scratch rows of one batch
    const Grid<dim>    &grid;
    const Loads<dim>   &loads;
    NodalFields<dim>   &nodes;
  };
} // namespace talus

#endif
