#ifndef talus_equilibrium_kept_weights_h
#define talus_equilibrium_kept_weights_h

#include <talus/equilibrium/unknowns.h>
#include <talus/transfer/weights.h>

#include <vector>

namespace talus
{
  /// The weights of all points, kept for a load step: for each segment the
  /// nodes that any of its points touch, and for each point the weights at all
  /// of these. Hanging nodes have passed theirs on to their masters, and nodes
  /// without unknowns have none.
  template <int dim>
  class KeptWeights
  {
  public:
    void
    compute(const Points<dim>   &points,
            const Grid<dim>     &grid,
            const BoxShape      &shape,
            const Unknowns<dim> &unknowns);

    /// The nodes of a segment.
    struct Patch
    {
      const unsigned int *nodes;
      unsigned int        n_nodes;
    };

    Patch
    patch(const unsigned int segment) const
    {
      return {nodes_.data() + first_node_[segment],
              first_node_[segment + 1] - first_node_[segment]};
    }

    /// Value and gradient, 1/m, at the nodes of the patch of the @p k-th point of
    /// the segment.
    struct Weight
    {
      double                 value;
      dealii::Tensor<1, dim> gradient;
    };

    const Weight *
    of_point(const unsigned int segment, const unsigned int k) const
    {
      return weights_.data() + first_weight_[segment] +
             k * std::size_t(patch(segment).n_nodes);
    }

  private:
    void
    add_segment(const Points<dim>   &points,
                const Grid<dim>     &grid,
                const BoxShape      &shape,
                const Segment       &segment,
                const Unknowns<dim> &unknowns);

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
