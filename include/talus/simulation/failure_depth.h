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
    /// Remember which points move: more than three tenths of the largest of
    /// @p mechanism, dim components for each point of this rank with largest
    /// component 1.
    void
    record(const std::vector<double> &mechanism);

    /// Sentences for the log on soil with the strength that it has: the depth of
    /// the mechanism below the mudline, and, if this is less than two cells, the
    /// strength one cell below the mudline against the weight of a cell. Empty
    /// if no mechanism was recorded or the mudline is not known. Points must be
    /// those of record(), in the same order. Collective.
    std::string
    note(const State<dim> &state, const Problem<dim> &problem) const;

  private:
    std::vector<bool> moves_; ///< by point
  };
} // namespace talus

#endif
