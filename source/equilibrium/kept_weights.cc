#include <talus/equilibrium/kept_weights.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  KeptWeights<dim>::compute(const Points<dim>   &points,
                            const Grid<dim>     &grid,
                            const BoxShape      &shape,
                            const Unknowns<dim> &unknowns)
  {
    first_node_.assign(1, 0);
    first_weight_.assign(1, 0);
    nodes_.clear();
    weights_.clear();
    hanging_.assign(grid.n_nodes(), nullptr);
    place_of_node_.assign(grid.n_nodes(), numbers::invalid_unsigned_int);
    for (const HangingNode &hanging : grid.hanging_nodes())
      hanging_[hanging.node] = &hanging;
    for (const Segment &segment : points.segments())
      add_segment(points, grid, shape, segment, unknowns);
  }



  template <int dim>
  void
  KeptWeights<dim>::add_segment(const Points<dim>   &points,
                                const Grid<dim>     &grid,
                                const BoxShape      &shape,
                                const Segment       &segment,
                                const Unknowns<dim> &unknowns)
  {
    // What each point gives to each node; a node may be named several times.
    struct Share
    {
      unsigned int point, place;
      Weight       weight;
    };
    std::vector<Share>           shares;
    std::vector<NodeWeight<dim>> weights;
    const unsigned int           first_node = nodes_.size();

    const auto add = [&](const unsigned int     p,
                         const unsigned int     node,
                         const double           factor,
                         const NodeWeight<dim> &weight) {
      if (!unknowns.is_active(node))
        return;
      unsigned int &place = place_of_node_[node];
      if (place == numbers::invalid_unsigned_int)
        {
          place = nodes_.size() - first_node;
          nodes_.push_back(node);
        }
      shares.push_back({p - segment.begin,
                        place,
                        {factor * weight.value, factor * weight.gradient}});
    };
    for (unsigned int p = segment.begin; p < segment.end; ++p)
      {
        weights_of_point(points, grid, shape, segment.cell, p, weights);
        for (const NodeWeight<dim> &weight : weights)
          if (const HangingNode *hanging = hanging_[weight.node])
            for (const auto &[node, factor] : hanging->masters)
              add(p, node, factor, weight);
          else
            add(p, weight.node, 1., weight);
      }

    const unsigned int n_nodes = nodes_.size() - first_node;
    const std::size_t  first   = weights_.size();
    weights_.resize(first + std::size_t(segment.end - segment.begin) * n_nodes,
                    Weight{0., Tensor<1, dim>()});
    for (const Share &share : shares)
      {
        Weight &weight =
          weights_[first + share.point * std::size_t(n_nodes) + share.place];
        weight.value += share.weight.value;
        weight.gradient += share.weight.gradient;
      }
    for (unsigned int i = first_node; i < nodes_.size(); ++i)
      place_of_node_[nodes_[i]] = numbers::invalid_unsigned_int;
    first_node_.push_back(nodes_.size());
    first_weight_.push_back(weights_.size());
  }



  template class KeptWeights<2>;
  template class KeptWeights<3>;
} // namespace talus
