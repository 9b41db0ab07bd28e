// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_boxes_h
#define talus_observers_boxes_h

#include <talus/state/state.h>
#include <talus/transfer/box_rule.h>

#include <array>
#include <cmath>
#include <limits>

namespace talus
{
  /// Maximum length of a box along an axis, m, that the weights allow in a cell
  /// of @p cell_size, m.
  template <int dim>
  inline double
  longest_box(const State<dim> &state, const double cell_size)
  {
    return 2. * state.constants.box_shape.max_half * cell_size;
  }



  /// Return the edge vectors of the box of point @p p, m: parallel to the axes,
  /// or oblique for a convected domain. A box longer than @p longest, m, along
  /// an axis is shortened to @p longest, because F grows without bound in a
  /// shear layer. A box too thin for the weights is not thickened, so that
  /// boxes cover the soil once.
  template <int dim>
  inline std::array<dealii::Tensor<1, dim>, dim>
  box_edges(const State<dim> &state, const unsigned int p, const double longest)
  {
    const Points<dim>                      &points = state.points;
    const BoxShape                         &shape  = state.constants.box_shape;
    std::array<dealii::Tensor<1, dim>, dim> edges;
    for (unsigned int d = 0; d < dim; ++d)
      edges[d] = edge_of_box(points, shape.rule, d, p);
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



  /// Return the edge vectors of the box of point @p p, m, shortened to
  /// longest_box(). The box of a point without a cell is not shortened.
  template <int dim>
  inline std::array<dealii::Tensor<1, dim>, dim>
  box_edges(const State<dim> &state, const unsigned int p)
  {
    const Points<dim> &points = state.points;
    return box_edges(
      state,
      p,
      p >= points.n_sorted()
        ? std::numeric_limits<double>::infinity()
        : longest_box(state, state.grid.cells()[points.cell_of(p)].size));
  }



  /// Extent along each axis, m, of a box with the given edges; for a convected
  /// domain from the lowest to the highest corner.
  template <int dim>
  inline dealii::Tensor<1, dim>
  lengths_of(const std::array<dealii::Tensor<1, dim>, dim> &edges)
  {
    dealii::Tensor<1, dim> lengths;
    for (const auto &edge : edges)
      for (unsigned int d = 0; d < dim; ++d)
        lengths[d] += std::abs(edge[d]);
    return lengths;
  }



  /// Extent of the box of point @p p along each axis, m; see box_edges().
  template <int dim>
  inline dealii::Tensor<1, dim>
  box_lengths(const State<dim> &state, const unsigned int p)
  {
    return lengths_of<dim>(box_edges(state, p));
  }
} // namespace talus

#endif
