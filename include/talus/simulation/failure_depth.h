// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_failure_depth_h
#define talus_simulation_failure_depth_h

#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <string>
#include <vector>

namespace talus
{
  /// Depth of a failure mechanism, compared with the cell size.
  template <int dim>
  class FailureDepth
  {
  public:
    /// Store the motion of the points: @p mechanism has dim components per
    /// point of the local rank, of any unit.
    void
    record(const std::vector<double> &mechanism);

    /// Return sentences for the log on the depth of the mechanism at the actual
    /// strength of the soil. The depth below the mudline contains nine tenths
    /// of the motion, weighted by volume and squared displacement. If the depth
    /// is less than two cells, the sentences also compare the strength one cell
    /// below the mudline with the weight of a cell. A second sentence is a
    /// remark that the factor of safety @p factor [-] is too high if one row of
    /// cells shears. Empty without a recorded mechanism or without a mudline.
    /// The points must have the order of record(). Collective.
    std::vector<Remark>
    notes(const State<dim>   &state,
          const Problem<dim> &problem,
          double              factor) const;

  private:
    std::vector<double> square_; ///< squared displacement by point
  };
} // namespace talus

#endif
