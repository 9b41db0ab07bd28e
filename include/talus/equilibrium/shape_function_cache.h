// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_shape_function_cache_h
#define talus_equilibrium_shape_function_cache_h

#include <talus/equilibrium/unknowns.h>
#include <talus/transfer/weights.h>

#include <vector>

namespace talus
{
  /// Shape functions (weights) of all points, stored for a load step. A patch
  /// is the list of nodes touched by any point of a cell; each point of the
  /// cell has a weight at every node of the patch. Weights of hanging nodes are
  /// distributed to their master nodes; nodes without unknowns are left out.
  template <int dim>
  class ShapeFunctionCache
  {
  public:
    /// Compute the weights of all points at the nodes with unknowns, for points
    /// with boxes of the given shape.
    void
    compute(const Points<dim>   &points,
            const Grid<dim>     &grid,
            const BoxShape      &shape,
            const Unknowns<dim> &unknowns);

    /// Points of each occupied cell, as one batch per cell.
    const std::vector<Batch> &
    cells() const
    {
      return cells_;
    }

    /// Nodes touched by the points of a cell.
    struct Patch
    {
      const unsigned int *nodes;
      unsigned int        n_nodes;
    };

    Patch
    patch(const unsigned int c) const
    {
      return {nodes_.data() + first_node_[c],
              first_node_[c + 1] - first_node_[c]};
    }

    /// Return the nodes of patch @p c as an array.
    dealii::ArrayView<const unsigned int>
    nodes(const unsigned int c) const
    {
      return {patch(c).nodes, patch(c).n_nodes};
    }

    /// Value [-] and gradient, 1/m, of the weight of a point at a node of the
    /// patch.
    struct Weight
    {
      double                 value;
      dealii::Tensor<1, dim> gradient;
    };

    /// Weights of the @p k-th point of cell number @p c, one for each node of
    /// the patch.
    const Weight *
    of_point(const unsigned int c, const unsigned int k) const
    {
      return weights_.data() + first_weight_[c] +
             k * std::size_t(patch(c).n_nodes);
    }

    /// Call action(point, node, value) for all weights.
    template <typename Action>
    void
    for_each_weight(const Action &action) const
    {
      for (unsigned int c = 0; c < cells_.size(); ++c)
        for (unsigned int p = cells_[c].begin; p < cells_[c].end; ++p)
          for (unsigned int a = 0; a < patch(c).n_nodes; ++a)
            action(p,
                   patch(c).nodes[a],
                   of_point(c, p - cells_[c].begin)[a].value);
    }

  private:
    /// Contribution of a point to a node; several may belong to the same pair.
    struct Share
    {
      unsigned int point, place; ///< index in the cell, index in the patch
      Weight       weight;
    };

    void
    add_cell(const Points<dim>   &points,
             const Grid<dim>     &grid,
             const BoxShape      &shape,
             const Batch         &cell,
             const Unknowns<dim> &unknowns);

    void
    store(const Batch              &cell,
          unsigned int              first_node,
          const std::vector<Share> &shares);

    std::vector<Batch>        cells_;
    std::vector<unsigned int> first_node_;
    std::vector<unsigned int> nodes_;
    std::vector<std::size_t>  first_weight_;
    std::vector<Weight>       weights_;

    // Scratch memory of compute()
    std::vector<const HangingNode *> hanging_;
    std::vector<unsigned int>        place_of_node_;
  };
} // namespace talus

#endif
