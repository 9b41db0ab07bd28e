// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_boxes_h
#define talus_observers_boxes_h

#include <talus/state/state.h>
#include <talus/transfer/box_rule.h>

#include <array>
#include <cmath>

namespace talus
{
  /// The edges of the box of point @p p, m: along the axes, or those of a
  /// convected domain. A box that is longer than the weights let it be is as long
  /// as they do: in a shear layer F grows without bound. One that is too thin for
  /// the weights is as thin as it is, so that boxes cover the soil once. Points
  /// that are in no cell yet have their whole box.
  template <int dim>
  inline std::array<dealii::Tensor<1, dim>, dim>
  box_edges(const State<dim> &state, const unsigned int p)
  {
    const Points<dim>                      &points = state.points;
    const BoxShape                         &shape  = state.box_shape;
    std::array<dealii::Tensor<1, dim>, dim> edges;
    for (unsigned int d = 0; d < dim; ++d)
      if (shape.rule != BoxRule::fixed)
        edges[d] = edge_of_box(points, shape.rule, d, p);
      else
        edges[d][d] = points.data(points.reference_length, d)[p];
    if (p >= points.n_sorted())
      return edges;
    const double longest =
      2. * shape.most_half * state.grid.cells()[points.cell_of(p)].size;
    for (unsigned int i = 0; i < dim; ++i)
      {
        double length = 0;
        for (const auto &edge : edges)
          length += std::abs(edge[i]);
        if (length > longest)
          for (auto &edge : edges)
            edge[i] *= longest / length;
      }
    return edges;
  }



  /// Length of the box of point @p p along each axis, m; of a convected domain,
  /// from its lowest to its highest corner. See box_edges().
  template <int dim>
  inline dealii::Tensor<1, dim>
  box_lengths(const State<dim> &state, const unsigned int p)
  {
    dealii::Tensor<1, dim> lengths;
    for (const auto &edge : box_edges(state, p))
      for (unsigned int d = 0; d < dim; ++d)
        lengths[d] += std::abs(edge[d]);
    return lengths;
  }
} // namespace talus

#endif
