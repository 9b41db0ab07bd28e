// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_drainage_h
#define talus_problem_drainage_h

#include <talus/base/remark.h>
#include <talus/materials/materials.h>
#include <talus/problem/body_thickness.h>

#include <vector>

namespace talus
{
  /// Return a remark for each body with undrained pore water on the stiffness
  /// of the water, and for each body with a coefficient of consolidation c_v on
  /// the drainage. In a run of @p duration T, s, water moves sqrt(c_v T): soil
  /// is undrained if water stays in its cell, and drained if water crosses the
  /// soil.
  template <int dim>
  std::vector<Remark>
  notes_on_drainage(const Materials<dim>             &materials,
                    const std::vector<BodyThickness> &bodies,
                    double                            duration);
} // namespace talus

#endif
