// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_weights_h
#define talus_transfer_weights_h

#include <talus/grid/grid.h>
#include <talus/transfer/box_rule.h>

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



  /// Weights by the definition: for every cell that the box overlaps, the mean
  /// of its shape functions over the overlap, times the overlap's share of the
  /// box. Any cells may touch cell @p c, hanging nodes included (whose share
  /// NodalFields::sum_over_ranks() passes on); a node may be listed several times.
  ///
  /// @param half half lengths of the box, m, at most half of the cell.
  template <int dim>
  void
  general_weights(const Grid<dim>              &grid,
                  unsigned int                  c,
                  const dealii::Point<dim>     &centre,
                  const dealii::Tensor<1, dim> &half,
                  std::vector<NodeWeight<dim>> &weights);

  /// The same for the box of point @p p in cell @p c.
  template <int dim>
  void
  weights_of_point(const Points<dim>            &points,
                   const Grid<dim>              &grid,
                   const BoxShape               &shape,
                   unsigned int                  c,
                   unsigned int                  p,
                   std::vector<NodeWeight<dim>> &weights);
} // namespace talus

#endif
