// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_weights_h
#define talus_transfer_weights_h

#include <talus/grid/grid.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/weights_kernel.h>

#include <vector>

namespace talus
{
  /// Weight of a point at one node.
  template <int dim>
  struct NodeWeight
  {
    unsigned int           node;
    double                 value;
    dealii::Tensor<1, dim> gradient; ///< 1/m
  };



  template <int dim>
  using NodeWeights = std::vector<NodeWeight<dim>>;



  /// Compute the weights of a box by definition: for every cell that the box
  /// overlaps, the mean of the shape functions over the overlap, times the
  /// fraction of the box in the overlap. Cells of any size may touch cell @p c.
  /// A node may be listed several times. Hanging nodes are listed;
  /// NodalFields::sum_over_ranks() distributes their sums.
  ///
  /// @param c cell of the point
  /// @param centre of the box, m
  /// @param half half lengths of the box, m, at most half of the cell
  /// @param weights result; previous entries are removed
  template <int dim>
  void
  general_weights(const Grid<dim>              &grid,
                  unsigned int                  c,
                  const dealii::Point<dim>     &centre,
                  const dealii::Tensor<1, dim> &half,
                  std::vector<NodeWeight<dim>> &weights);

  /// Compute the weights of a point by definition, for any box rule; see
  /// general_weights().
  ///
  /// @param c cell of the point
  /// @param p index of the point
  /// @param weights result; previous entries are removed
  template <int dim>
  void
  weights_of_point(const Points<dim>            &points,
                   const Grid<dim>              &grid,
                   const BoxShape               &shape,
                   unsigned int                  c,
                   unsigned int                  p,
                   std::vector<NodeWeight<dim>> &weights);



  /// Weights of the box of point @p p at the four nodes of the patch of its
  /// cell along axis @p d [-].
  template <int dim>
  TALUS_ALWAYS_INLINE std::array<double, 4>
                      weights_along_axis(const Points<dim> &points,
                                         const BoxShape    &shape,
                                         const Cell<dim>   &cell,
                                         const unsigned int d,
                                         const unsigned int p)
  {
    return axis_weights(
             (points.data(points.position, d)[p] - cell.lower[d]) / cell.size,
             half_length_in_cells<dim>(points, shape, d, p, 1. / cell.size))
      .value;
  }
} // namespace talus

#endif
