// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_null_space_filter_h
#define talus_simulation_null_space_filter_h

#include <talus/boundaries/boundaries.h>
#include <talus/materials/materials.h>
#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  /// Remove velocities and mean stresses of the points that are invisible to
  /// the background grid.
  ///
  /// Points outnumber nodes, so there are velocities of the points that sum to
  /// zero at every node: the null space of the transfer. FLIP never changes
  /// null-space velocities, and they accumulate: in a slide at rest points move
  /// at up to 1 m/s. At fixed intervals the filter replaces the velocities by
  /// XPIC(m), which keeps everything that m passes to the grid and back can
  /// see, and hardly damps the motion. @cite hammerquist2017 Momentum is
  /// conserved; the kinetic energy removed is part of the remainder of the
  /// energy budget.
  ///
  /// The mean stress has a null space, too: under B-bar the nodes feel only the
  /// mean over the cell, and the differences of the points from the mean
  /// accumulate as points move from cell to cell. The filter replaces the mean
  /// stress by the cell mean, which changes no nodal force. @cite alkafaji2013
  /// In undrained soil the pressure of the water changes.
  /// Laws that compute the stress from the deformation gradient restore their
  /// stress in the next step.
  ///
  /// With @p boundaries the nodes on held faces stay at rest in each pass: the
  /// filter then keeps the shear beside the face, and removes velocities of
  /// points that the face holds.
  ///
  /// The order of XPIC is a parameter of the scheme. Collective.
  template <int dim>
  void
  filter_null_space(State<dim>           &state,
                    const Materials<dim> &materials,
                    const Transfer<dim>  &transfer,
                    Boundaries<dim>      *boundaries = nullptr);
} // namespace talus

#endif
