// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_boxes_h
#define talus_observers_boxes_h

#include <talus/state/state.h>
#include <talus/transfer/box_rule.h>

#include <algorithm>
#include <array>
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



  /// Extent of the box of point @p p along each axis, m, at most @p longest;
  /// for a convected domain from the lowest to the highest corner. Boxes are
  /// longer only where a limit keeps points from being split. A box too thin
  /// for the weights is not thickened, so that boxes cover the soil once.
  template <int dim>
  inline dealii::Tensor<1, dim>
  box_lengths(const Points<dim> &points,
              const unsigned int p,
              const double       longest)
  {
    auto lengths = load_vector(points, points.box_length, p);
    for (unsigned int d = 0; d < dim; ++d)
      lengths[d] = std::min(lengths[d], longest);
    return lengths;
  }



  /// As above, with the length that the weights allow. The box of a point
  /// without a cell is not shortened.
  template <int dim>
  inline dealii::Tensor<1, dim>
  box_lengths(const State<dim> &state, const unsigned int p)
  {
    const Points<dim> &points = state.points;
    return box_lengths(
      points,
      p,
      p >= points.n_sorted()
        ? std::numeric_limits<double>::infinity()
        : longest_box(state, state.grid.cells()[points.cell_of(p)].size));
  }



  /// Edges of the domain of point @p p for pictures, m: of the cell of the
  /// point, which tiles the soil with its neighbours, or of the box where boxes
  /// count shear or keep their lengths. Scaled along each axis to
  /// box_lengths().
  template <int dim>
  inline std::array<dealii::Tensor<1, dim>, dim>
  drawn_edges(const State<dim> &state, const unsigned int p)
  {
    const BoxRule rule = state.constants.box_shape.rule;
    const bool is_box = rule == BoxRule::left_stretch || rule == BoxRule::fixed;
    const auto longest  = box_lengths(state, p);
    const auto unbroken = load_vector(state.points, state.points.box_length, p);
    std::array<dealii::Tensor<1, dim>, dim> edges;
    for (unsigned int k = 0; k < dim; ++k)
      {
        if (is_box)
          edges[k][k] = longest[k];
        else
          {
            edges[k] = edge_of_cell(state.points, k, p);
            for (unsigned int d = 0; d < dim; ++d)
              edges[k][d] *= longest[d] / unbroken[d];
          }
      }
    return edges;
  }
} // namespace talus

#endif
