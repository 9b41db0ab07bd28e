// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/shape_function_cache.h>

namespace talus
{
  using namespace dealii;

  /// The weights are constant within a load step and used in all its
  /// evaluations and matrices. Hence they are computed once, by definition (box
  /// by box, cell by cell), and hanging nodes are resolved here. The explicit
  /// step uses its weights twice and recomputes them instead. Memory: points of
  /// a cell times nodes of the cell, 24 bytes each in 2-D and 32 bytes in 3-D.
  template <int dim>
  void
  ShapeFunctionCache<dim>::compute(const Points<dim>   &points,
                                   const Grid<dim>     &grid,
                                   const BoxShape      &shape,
                                   const Unknowns<dim> &unknowns)
  {
    cells_.clear();
    // Ends of the lists: cell c owns the entries between numbers c and c + 1.
    first_node_.assign(1, 0);
    first_weight_.assign(1, 0);
    nodes_.clear();
    weights_.clear();
    hanging_.assign(grid.n_nodes(), nullptr);
    place_of_node_.assign(grid.n_nodes(), numbers::invalid_unsigned_int);
    for (const HangingNode &hanging : grid.hanging_nodes())
      hanging_[hanging.node] = &hanging;
    points.for_each_cell(points.all(), [&](const Batch &cell) {
      add_cell(points, grid, shape, cell, unknowns);
    });
  }



  /// Nodes are numbered in the order in which the points of the cell touch
  /// nodes, and their number is known only after the last point. Hence shares
  /// are collected first and then arranged by store().
  template <int dim>
  void
  ShapeFunctionCache<dim>::add_cell(const Points<dim>   &points,
                                    const Grid<dim>     &grid,
                                    const BoxShape      &shape,
                                    const Batch         &cell,
                                    const Unknowns<dim> &unknowns)
  {
    std::vector<Share>           shares;
    std::vector<NodeWeight<dim>> weights;
    const unsigned int           first_node = nodes_.size();

    const auto add = [&](const unsigned int     p,
                         const unsigned int     node,
                         const double           factor,
                         const NodeWeight<dim> &weight) {
      // Lighter nodes have no unknowns; their displacement counts as zero.
      if (!unknowns.is_active(node))
        return;
      unsigned int &place = place_of_node_[node];
      if (place == numbers::invalid_unsigned_int)
        {
          place = nodes_.size() - first_node;
          nodes_.push_back(node);
        }
      shares.push_back({p - cell.begin,
                        place,
                        {factor * weight.value, factor * weight.gradient}});
    };
    const unsigned int c = points.segments()[cell.first_segment].cell;
    for (unsigned int p = cell.begin; p < cell.end; ++p)
      {
        weights_of_point(points, grid, shape, c, p, weights);
        for (const NodeWeight<dim> &weight : weights)
          // The displacement of a hanging node is the mean of its masters, so
          // the masters share its weight.
          if (const HangingNode *hanging = hanging_[weight.node])
            for (const auto &[node, factor] : hanging->masters)
              add(p, node, factor, weight);
          else
            add(p, weight.node, 1., weight);
      }

    store(cell, first_node, shares);
  }



  /// Store the weights of the points of a cell as rows, from the collected
  /// @p shares, and prepare the lists for the next cell.
  template <int dim>
  void
  ShapeFunctionCache<dim>::store(const Batch              &cell,
                                 const unsigned int        first_node,
                                 const std::vector<Share> &shares)
  {
    const unsigned int n_nodes = nodes_.size() - first_node;
    const std::size_t  first   = weights_.size();
    weights_.resize(first + std::size_t(cell.end - cell.begin) * n_nodes,
                    Weight{0., Tensor<1, dim>()});
    for (const Share &share : shares)
      {
        // Sum up: a point has several shares for a node that is touched in
        // several cells or is master of several hanging nodes.
        Weight &weight =
          weights_[first + share.point * std::size_t(n_nodes) + share.place];
        weight.value += share.weight.value;
        weight.gradient += share.weight.gradient;
      }
    for (unsigned int i = first_node; i < nodes_.size(); ++i)
      place_of_node_[nodes_[i]] = numbers::invalid_unsigned_int;
    cells_.push_back(cell);
    first_node_.push_back(nodes_.size());
    first_weight_.push_back(weights_.size());
  }



  template class ShapeFunctionCache<2>;
  template class ShapeFunctionCache<3>;
} // namespace talus
