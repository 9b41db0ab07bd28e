// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_stiffness_h
#define talus_problem_stiffness_h

#include <talus/base/remark.h>
#include <talus/materials/materials.h>
#include <talus/problem/body_thickness.h>

#include <vector>

namespace talus
{
  /// Return a remark for each body of a plastic material that is too soft for
  /// its weight or its strength: elastic strains then are a part of the flow.
  /// Bodies without strength deform as their moduli say. Collective.
  /// @param points of this rank, undeformed
  /// @param materials of the bodies
  /// @param bodies with their thickness
  /// @param gravity m/s^2
  /// @param communicator of all ranks
  template <int dim>
  std::vector<Remark>
  notes_on_stiffness(const Points<dim>                &points,
                     const Materials<dim>             &materials,
                     const std::vector<BodyThickness> &bodies,
                     double                            gravity,
                     MPI_Comm                          communicator);
} // namespace talus

#endif
