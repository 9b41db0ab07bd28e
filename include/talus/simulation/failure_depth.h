// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_failure_depth_h
#define talus_simulation_failure_depth_h

#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <string>
#include <vector>

namespace talus
{
  /// How deep a mechanism of failure reaches, against the size of the cells.
  template <int dim>
  class FailureDepth
  {
  public:
    /// Remember the motion of the points: @p mechanism with dim components for
    /// each point of this rank, of any unit.
    void
    record(const std::vector<double> &mechanism);

    /// Sentences for the log on soil with the strength that it has: the depth
    /// below the mudline above which nine tenths of the motion lie, by volume and
    /// square of the displacement, and, if this is less than two cells, the
    /// strength one cell below the mudline against the weight of a cell. Empty
    /// if no mechanism was recorded or the mudline is not known. Points must be
    /// those of record(), in the same order. Collective.
    std::string
    note(const State<dim> &state, const Problem<dim> &problem) const;

  private:
    std::vector<double> square_; ///< of the displacement, by point
  };
} // namespace talus

#endif
