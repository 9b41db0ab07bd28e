// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_plan_places_h
#define talus_problem_plan_places_h

#include <talus/base/box.h>

#include <vector>

namespace talus
{
  /// Return places on the bottom of @p domain, about @p distance apart, m: the
  /// centres of the cells of a lattice in plan.
  template <int dim>
  std::vector<dealii::Point<dim>>
  plan_places(const Box<dim> &domain, double distance);
} // namespace talus

#endif
