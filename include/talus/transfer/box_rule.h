// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_rule_h
#define talus_transfer_box_rule_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_shape.h>

namespace talus
{
  /// Update the lengths of the boxes of the points [begin, end), m, from the
  /// edges of their cells. Boxes with the rule `fixed` keep their lengths.
  template <int dim>
  void
  update_box_lengths(Points<dim> &points,
                     unsigned int begin,
                     unsigned int end,
                     BoxRule      rule);

  /// Set the lengths of the boxes and the lengths at creation, m, of the points
  /// [begin, end) from the edges of their cells: the splitter measures stretch
  /// from now on.
  template <int dim>
  void
  begin_stretch(Points<dim> &points,
                unsigned int begin,
                unsigned int end,
                BoxRule      rule);

  /// Return the lengths of the edges of point @p p before any deformation, m:
  /// the lengths at creation, scaled to the reference volume. Exact unless the
  /// point comes from soil that was deformed when it was split or merged.
  template <int dim>
  dealii::Tensor<1, dim>
  reference_lengths(const Points<dim> &points, unsigned int p);

  /// Return edge @p k of the cell of point @p p, m.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_of_cell(const Points<dim> &points, unsigned int k, unsigned int p);

  /// Return the edge of point @p p along which splits of direction @p d halve
  /// the point, m. Boxes that count shear are halved along the axes, all other
  /// points along the edges of their cells.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_to_split(const Points<dim> &points,
                BoxRule            rule,
                unsigned int       d,
                unsigned int       p);

  /// Return the length of edge_to_split(), m.
  template <typename Number, int dim>
  TALUS_ALWAYS_INLINE Number
  length_to_split(const PointsView<dim, const double> &points,
                  const BoxRule                        rule,
                  const unsigned int                   d,
                  const unsigned int                   p)
  {
    if (rule == BoxRule::left_stretch)
      return load<Number>(points.data(points.box_length, d) + p);
    Number square(0.);
    for (unsigned int i = 0; i < dim; ++i)
      {
        const auto a = load<Number>(points.data(points.edges, dim * i + d) + p);
        square += a * a;
      }
    return sqrt(square);
  }

  /// Count the pairs of box and axis that are clipped for the weights, on this
  /// rank.
  template <int dim>
  unsigned long
  count_clipped_boxes(const Points<dim> &points,
                      const Grid<dim>   &grid,
                      const BoxShape    &shape);
} // namespace talus

#endif
