// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_shape_function_cache_h
#define talus_equilibrium_shape_function_cache_h

#include <talus/equilibrium/unknowns.h>
#include <talus/transfer/weights.h>

#include <vector>

namespace talus
{
  /// The weights of all points, kept for a load step: for each cell the
  /// nodes that any of its points touch, and for each point the weights at all
  /// of these. Hanging nodes have passed theirs on to their masters, and nodes
  /// without unknowns have none.
  template <int dim>
  class ShapeFunctionCache
  {
  public:
    void
    compute(const Points<dim>   &points,
            const Grid<dim>     &grid,
            const BoxShape      &shape,
            const Unknowns<dim> &unknowns);

    /// The points of each cell that holds any.
    const std::vector<Batch> &
    cells() const
    {
      return cells_;
    }

    /// The nodes of a cell's points.
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

    /// Value and gradient, 1/m, at the nodes of the patch of the @p k-th point of
    /// cell number @p c.
    struct Weight
    {
      double                 value;
      dealii::Tensor<1, dim> gradient;
    };

    const Weight *
    of_point(const unsigned int c, const unsigned int k) const
    {
      return weights_.data() + first_weight_[c] +
             k * std::size_t(patch(c).n_nodes);
    }

  private:
    /// What a point gives to a node, which it may name several times.
    struct Share
    {
      unsigned int point, place; ///< in the cell and in its patch
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

    // While computing
    std::vector<const HangingNode *> hanging_;
    std::vector<unsigned int>        place_of_node_;
  };
} // namespace talus

#endif
