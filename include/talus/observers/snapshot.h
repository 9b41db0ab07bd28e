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
  /// Points, nodes, work and counts are this rank's share; observers sum up.
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



  /// Full, unclipped length of the box of point @p p along axis @p d, m.
  template <int dim>
  inline double
  box_length(const Snapshot<dim> &snapshot,
             const unsigned int   d,
             const unsigned int   p)
  {
    const Points<dim> &points = snapshot.points;
    const double       length = points.data(points.reference_length, d)[p];
    return snapshot.box_shape.rule == BoxRule::fixed
             ? length
             : length * points.data(points.stretch, d)[p];
  }
} // namespace talus

#endif
