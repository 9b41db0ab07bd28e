// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/nodal_gaps.h>
#include <talus/transfer/weights.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  NodalGaps<dim>::prepare(const Grid<dim> &grid, std::vector<Surface> surfaces)
  {
    surfaces_ = std::move(surfaces);
    exchange_.prepare(grid, surfaces_.size());
    gaps_.assign(surfaces_.size() * grid.n_nodes(), none);
    is_open_.assign(grid.n_nodes(), 0);
    of_point_.resize(surfaces_.size());
  }



  template <int dim>
  void
  NodalGaps<dim>::find(const State<dim>                  &state,
                       const std::vector<NodeAndSurface> &pairs,
                       const std::vector<unsigned char>  &nearness)
  {
    const std::size_t n = surfaces_.size();
    // Surfaces that are not beside an owned node count as closed there: nobody
    // asks for them, and they must not keep points busy. Of ghosts all are open,
    // since only the owner knows all surfaces beside a node, and all their
    // records travel.
    present_.clear();
    for (const NodeAndSurface &pair : pairs)
      if (pair.node >= state.grid.n_owned_nodes() ||
          state.nodes.mass(pair.node) > 0)
        present_.push_back(pair);
    for (const NodeAndSurface &pair : present_)
      std::fill_n(gaps_.begin() + n * pair.node, n, -none);
    for (const NodeAndSurface &pair : present_)
      {
        gaps_[n * pair.node + pair.surface] = none;
        is_open_[pair.node]                 = 1;
      }
    std::fill(gaps_.begin() + n * state.grid.n_owned_nodes(),
              gaps_.end(),
              none);
    closed_ = dead_band * state.grid.finest_size();
    // The nearest cells first: they close most nodes, and the points behind them
    // need not be looked at.
    later_.clear();
    for (const Segment &segment : state.points.segments())
      if (nearness[segment.cell] == 2)
        add_segment(state, segment);
      else if (nearness[segment.cell] == 1)
        later_.push_back(segment);
    for (const Segment &segment : later_)
      add_segment(state, segment);
    for (const NodeAndSurface &pair : present_)
      is_open_[pair.node] = 0;
    exchange_.minimum_to_owners(gaps_.data());
    exchange_.copy_to_ghosts(gaps_.data());
  }



  namespace
  {
    /// Which entries of the patch of a uniform cell a box reaches: nodes that are
    /// nearer than a cell and the half length, along each axis.
    template <int dim>
    class PatchReach
    {
    public:
      /// @p half in cells.
      PatchReach(const Cell<dim>      &cell,
                 const Point<dim>     &x,
                 const Tensor<1, dim> &half)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double at = (x[d] - cell.lower[d]) / cell.size;
            for (int i = 0; i < 4; ++i)
              bits_[d] |= (std::abs(at - (i - 1)) < 1. + half[d]) << i;
          }
      }

      bool
      operator()(const unsigned int k) const
      {
        unsigned int all = 1;
        for (unsigned int d = 0; d < dim; ++d)
          all &= bits_[d] >> (k / power(4, d) % 4);
        return all;
      }

    private:
      std::array<unsigned int, dim> bits_{}; ///< by axis
    };
  } // namespace



  /// Half lengths of the box of a point, in cells.
  template <int dim>
  Tensor<1, dim>
  NodalGaps<dim>::half_lengths(const State<dim>  &state,
                               const Cell<dim>   &cell,
                               const unsigned int p) const
  {
    Tensor<1, dim> half;
    for (unsigned int d = 0; d < dim; ++d)
      half[d] = half_length_in_cells<dim>(
        state.points, state.box_shape, d, p, 1. / cell.size);
    return half;
  }



  template <int dim>
  void
  NodalGaps<dim>::find_of_point(const Point<dim> &x, const Tensor<1, dim> &half)
  {
    for (std::size_t k = 0; k < surfaces_.size(); ++k)
      of_point_[k] = surfaces_[k](x, half);
  }



  template <int dim>
  void
  NodalGaps<dim>::lower(const unsigned int node)
  {
    const std::size_t n       = surfaces_.size();
    bool              is_open = false;
    for (std::size_t k = 0; k < n; ++k)
      {
        double &gap = gaps_[n * node + k];
        gap         = std::min(gap, of_point_[k]);
        is_open     = is_open || gap > closed_;
      }
    is_open_[node] = is_open;
  }



  // In a uniform cell the nodes that a box reaches follow from where it is. In
  // others, and of convected domains, the weights tell.
  template <int dim>
  void
  NodalGaps<dim>::add_segment(const State<dim> &state, const Segment &segment)
  {
    const Cell<dim> &cell = state.grid.cells()[segment.cell];
    if (cell.uniform && state.box_shape.rule != BoxRule::convected_domain)
      {
        add_to_patch(state, segment);
        return;
      }
    std::vector<NodeWeight<dim>> weights;
    for (unsigned int p = segment.begin; p < segment.end; ++p)
      {
        find_of_point(load_place(state.points, state.points.position, p),
                      cell.size * half_lengths(state, cell, p));
        weights_of_point(
          state.points, state.grid, state.box_shape, segment.cell, p, weights);
        for (const NodeWeight<dim> &weight : weights)
          if (weight.value > 0 && is_open_[weight.node])
            lower(weight.node);
      }
  }



  /// Nodes that are closed already are not looked at any more, nor are points
  /// when all are: soil that rests closes its nodes with its first points.
  template <int dim>
  void
  NodalGaps<dim>::add_to_patch(const State<dim> &state, const Segment &segment)
  {
    const Cell<dim> &cell = state.grid.cells()[segment.cell];
    std::array<unsigned int, power(4, dim)> open; // entries of the patch
    unsigned int                            n_open = 0;
    for (unsigned int k = 0; k < cell.patch.size(); ++k)
      if (is_open_[cell.patch[k]])
        open[n_open++] = k;
    for (unsigned int p = segment.begin; p < segment.end && n_open > 0; ++p)
      {
        const Tensor<1, dim> half = half_lengths(state, cell, p);
        const Point<dim> x = load_place(state.points, state.points.position, p);
        const PatchReach<dim> reaches(cell, x, half);
        if (std::none_of(open.begin(), open.begin() + n_open, reaches))
          continue;
        find_of_point(x, cell.size * half);
        unsigned int n_left = 0;
        for (unsigned int i = 0; i < n_open; ++i)
          {
            const unsigned int node = cell.patch[open[i]];
            if (reaches(open[i]) && is_open_[node])
              lower(node);
            if (is_open_[node])
              open[n_left++] = open[i];
          }
        n_open = n_left;
      }
  }



  template class NodalGaps<2>;
  template class NodalGaps<3>;
} // namespace talus
