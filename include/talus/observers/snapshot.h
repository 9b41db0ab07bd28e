#ifndef talus_observers_snapshot_h
#define talus_observers_snapshot_h

#include <talus/adaptivity/split_statistics.h>
#include <talus/boundaries/boundary_work.h>
#include <talus/grid/nodal_fields.h>
#include <talus/points/points.h>
#include <talus/transfer/box_rule.h>

namespace talus
{
  /// Everything an observer may look at, after a step. Points are sorted; the
  /// nodal fields are those of the step that led here (none at the start).
  template <int dim>
  struct Snapshot
  {
    const Points<dim>       &points;
    const Grid<dim>         &grid;
    const NodalFields<dim>  &nodes;
    const BoundaryWork<dim> &boundary_work;
    const SplitStatistics   &splits;
    unsigned long            step;
    double                   time;      ///< s
    double                   time_step; ///< of the last step, s
    double          gravity_work;       ///< of weight and body forces so far, J
    const BoxShape &box_shape;
  };
} // namespace talus

#endif
