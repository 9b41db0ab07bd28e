// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_rule_h
#define talus_transfer_box_rule_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_shape.h>

namespace talus
{
  /// Update the stretch [-] of the points [begin, end) from deformation
  /// gradient and reference lengths. Boxes with the rule `fixed` have no
  /// stretch.
  template <int dim>
  void
  update_stretch(Points<dim> &points,
                 unsigned int begin,
                 unsigned int end,
                 BoxRule      rule);

  /// Set the stretch and the stretch at creation [-] of the points [begin, end)
  /// from their deformation gradient.
  template <int dim>
  void
  initialize_stretch(Points<dim> &points,
                     unsigned int begin,
                     unsigned int end,
                     BoxRule      rule);

  /// Return edge @p k of the cell of point @p p, m: column k of the deformation
  /// gradient times reference length k.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_of_cell(const Points<dim> &points, unsigned int k, unsigned int p);

  /// Return edge @p d of the box of point @p p, m, without clipping: an edge of
  /// the cell for convected domains, otherwise parallel to axis d.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_of_box(const Points<dim> &points,
              BoxRule            rule,
              unsigned int       d,
              unsigned int       p);

  /// Return the edge of point @p p along which splits of direction @p d halve
  /// the point, m. Boxes that count shear are halved along the axes, all other
  /// points along the edges of their cells.
  template <int dim>
  dealii::Tensor<1, dim>
  edge_to_split(const Points<dim> &points,
                BoxRule            rule,
                unsigned int       d,
                unsigned int       p);

  /// Return the stretch of edge_to_split() against its reference length [-].
  template <typename Number, int dim>
  TALUS_ALWAYS_INLINE Number
  stretch_to_split(const PointsView<dim, const double> &points,
                   const BoxRule                        rule,
                   const unsigned int                   d,
                   const unsigned int                   p)
  {
    if (rule == BoxRule::left_stretch)
      return load<Number>(points.data(points.stretch, d) + p);
    Number square(0.);
    for (unsigned int i = 0; i < dim; ++i)
      {
        const Number F = load<Number>(
          points.data(points.deformation_gradient, dim * i + d) + p);
        square += F * F;
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
