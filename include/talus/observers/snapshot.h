#ifndef talus_observers_snapshot_h
#define talus_observers_snapshot_h

#include <talus/adaptivity/split_statistics.h>
#include <talus/boundaries/boundary_work.h>
#include <talus/grid/nodal_fields.h>
#include <talus/points/points.h>
#include <talus/transfer/box_rule.h>

#include <array>
#include <cmath>

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



  /// Edge @p d of the box of point @p p, m: along axis d, or that of a convected
  /// domain. A box that is longer than the weights let it be is as long as they
  /// do: in a shear layer F grows without bound. One that is too thin for the
  /// weights is drawn as thin as it is, so that boxes cover the soil once.
  template <int dim>
  inline dealii::Tensor<1, dim>
  box_edge(const Snapshot<dim> &snapshot,
           const unsigned int   d,
           const unsigned int   p)
  {
    const Points<dim>                      &points = snapshot.points;
    std::array<dealii::Tensor<1, dim>, dim> edges;
    for (unsigned int e = 0; e < dim; ++e)
      if (snapshot.box_shape.rule != BoxRule::fixed)
        edges[e] = edge_of_box(points, snapshot.box_shape.rule, e, p);
      else
        edges[e][e] = points.data(points.reference_length, e)[p];
    if (p >= points.n_sorted())
      return edges[d]; // in no cell yet
    const double longest = 2. * snapshot.box_shape.most_half *
                           snapshot.grid.cells()[points.cell_of(p)].size;
    for (unsigned int i = 0; i < dim; ++i)
      {
        double length = 0;
        for (unsigned int e = 0; e < dim; ++e)
          length += std::abs(edges[e][i]);
        if (length > longest)
          edges[d][i] *= longest / length;
      }
    return edges[d];
  }



  /// Length of the box of point @p p along axis @p d, m; of a convected domain,
  /// from its lowest to its highest corner. See box_edge().
  template <int dim>
  inline double
  box_length(const Snapshot<dim> &snapshot,
             const unsigned int   d,
             const unsigned int   p)
  {
    double length = 0;
    for (unsigned int e = 0; e < dim; ++e)
      length += std::abs(box_edge(snapshot, e, p)[d]);
    return length;
  }
} // namespace talus

#endif
