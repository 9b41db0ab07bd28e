// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/transfer/weights.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  NodalGaps<dim>::prepare(const Grid<dim>          &grid,
                          std::vector<Surface>      surfaces,
                          std::vector<unsigned int> slots,
                          Near                      near,
                          PlaneOfCell               plane_of_cell,
                          TableOfCell               table_of_cell)
  {
    table_of_cell_ = std::move(table_of_cell);
    plane_of_cell_ = std::move(plane_of_cell);
    surfaces_      = std::move(surfaces);
    slots_         = std::move(slots);
    near_          = std::move(near);
    n_slots_ =
      slots_.empty() ? 0 : *std::max_element(slots_.begin(), slots_.end()) + 1;
    width_ = n_slots_ + 1;
    exchange_.prepare(grid, width_);
    records_.assign(width_ * grid.n_nodes(), none);
    fractions_.assign(grid.n_nodes(), 0.);
    is_open_.assign(grid.n_nodes(), 0);
    present_.clear();
    of_point_.resize(n_slots_);
  }



  template <int dim>
  void
  NodalGaps<dim>::find(const State<dim>                  &state,
                       const std::vector<NodeAndSurface> &pairs,
                       const std::vector<unsigned char>  &nearness,
                       const VolumeFraction              &volume_fraction)
  {
    const unsigned int n_owned = state.grid.n_owned_nodes();
    // At an owned node a slot without a surface near the node counts as closed:
    // the unused gap must not prolong the search. At a ghost node all slots are
    // open: only the owner knows all surfaces near a node, and whole records
    // are exchanged.
    for (const unsigned int node : present_)
      {
        std::fill_n(record(node), width_, none);
        fractions_[node] = 0.;
      }
    present_.clear();
    n_open_ = 0;
    for (const NodeAndSurface &pair : pairs)
      if (pair.node >= n_owned || state.nodes.mass(pair.node) > 0)
        {
          if (!is_open_[pair.node])
            {
              std::fill_n(record(pair.node), n_slots_, -none);
              is_open_[pair.node] = 1;
              ++n_open_;
              present_.push_back(pair.node);
            }
          record(pair.node)[slots_[pair.surface]] = none;
        }
    std::fill(records_.begin() + width_ * n_owned, records_.end(), none);
    closed_ = dead_band * state.grid.finest_size();
    // The nearest cells first: they close most nodes, and the points behind
    // need not be examined.
    later_.clear();
    for (const Segment &segment : state.points.segments())
      if (nearness[segment.cell] == 2)
        add_segment(state, segment);
      else if (nearness[segment.cell] == 1)
        later_.push_back(segment);
    for (const Segment &segment : later_)
      {
        if (n_open_ == 0)
          break;
        add_segment(state, segment);
      }
    for (const unsigned int node : present_)
      is_open_[node] = 0;
    exchange_.minimum_to_owners(records_.data(), none);
    if (volume_fraction)
      for (const unsigned int node : present_)
        if (node < n_owned)
          record(node)[n_slots_] = volume_fraction(node);
    exchange_.copy_to_ghosts(records_.data(), none);
    for (const unsigned int node : present_)
      if (const double fraction = record(node)[n_slots_]; fraction != none)
        fractions_[node] = fraction;
  }



  namespace
  {
    /// Set of entries of the patch of a cell, as bits.
    using PatchEntries = std::uint64_t;



    /// Return the entries of a uniform cell reached by a box with centre @p x,
    /// m, and half lengths @p half, in cells: along each axis the node is
    /// nearer than a cell plus the half length.
    template <int dim>
    PatchEntries
    entries_in_reach(const Cell<dim>      &cell,
                     const Point<dim>     &x,
                     const Tensor<1, dim> &half)
    {
      PatchEntries reached = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double       at = (x[d] - cell.lower[d]) / cell.size;
          const PatchEntries below_this_axis = reached;
          reached                            = 0;
          for (int i = 0; i < 4; ++i)
            if (std::abs(at - (i - 1)) < 1. + half[d])
              reached |= below_this_axis << (i * power(4, d));
        }
      return reached;
    }



    /// Return the entries whose nodes have a nonzero value in @p is_set.
    template <int dim>
    PatchEntries
    entries_with(const std::vector<unsigned char> &is_set,
                 const Cell<dim>                  &cell)
    {
      PatchEntries result = 0;
      for (unsigned int k = 0; k < cell.patch.size(); ++k)
        result |= PatchEntries(is_set[cell.patch[k]]) << k;
      return result;
    }
  } // namespace



  /// Half lengths of the box of point @p p, in cells, clipped as for weights.
  template <int dim>
  Tensor<1, dim>
  NodalGaps<dim>::half_lengths(const State<dim>  &state,
                               const Cell<dim>   &cell,
                               const unsigned int p) const
  {
    Tensor<1, dim> half;
    for (unsigned int d = 0; d < dim; ++d)
      half[d] = half_length_in_cells<dim>(
        state.points, state.constants.box_shape, d, p, 1. / cell.size);
    return half;
  }



  template <int dim>
  void
  NodalGaps<dim>::look_around(const Cell<dim> &cell)
  {
    if (surfaces_.size() == 1)
      {
        near_cell_.assign(1, 0u);
        return;
      }
    Point<dim> centre = cell.lower;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] += 0.5 * cell.size;
    near_cell_ = near_(centre, (2. * reach + 1.) * cell.size);
  }



  /// Compute of_point_ for a box: in each slot the distance of the nearest
  /// surface, since only the nearest surface can be near a node in reach.
  template <int dim>
  void
  NodalGaps<dim>::find_of_point(const Point<dim> &x, const Tensor<1, dim> &half)
  {
    std::fill(of_point_.begin(), of_point_.end(), none);
    for (const unsigned int k : near_cell_)
      {
        double &gap = of_point_[slots_[k]];
        gap         = std::min(gap, surfaces_[k](x, half));
      }
  }



  /// Compute of_point_ for a box by the table of the only surface near the
  /// cell, where the table reaches.
  template <int dim>
  void
  NodalGaps<dim>::find_of_point(const SurfaceTable<dim> &table,
                                const unsigned int       surface,
                                const Point<dim>        &x,
                                const Tensor<1, dim>    &half)
  {
    if (!table.reaches(x))
      {
        find_of_point(x, half);
        return;
      }
    const auto [distance, normal] = table.distance_and_normal(x);
    std::fill(of_point_.begin(), of_point_.end(), none);
    of_point_[slots_[surface]] = distance - support_of_box(half, normal);
  }



  /// Return whether a box is in contact by a margin that exceeds the deviation
  /// of the surface from @p plane; if so, set of_point_ to the gap from the
  /// plane. All gaps within the dead band count as closed, so the exact gap is
  /// not needed. @p half: half lengths of the box, m.
  template <int dim>
  bool
  NodalGaps<dim>::is_in_contact(const Plane          &plane,
                                const double          cell_size,
                                const Point<dim>     &x,
                                const Tensor<1, dim> &half)
  {
    const double gap = (x - plane.place) * plane.normal -
                       support_of_box<dim>(half, plane.normal);
    if (gap > closed_ - 0.5 * dead_band * cell_size)
      return false;
    std::fill(of_point_.begin(), of_point_.end(), none);
    of_point_[slots_[plane.surface]] = gap;
    return true;
  }



  template <int dim>
  void
  NodalGaps<dim>::lower(const unsigned int node)
  {
    bool is_open = false;
    for (std::size_t k = 0; k < n_slots_; ++k)
      {
        double &gap = record(node)[k];
        gap         = std::min(gap, of_point_[k]);
        is_open     = is_open || gap > closed_;
      }
    if (is_open_[node] && !is_open)
      --n_open_;
    is_open_[node] = is_open;
  }



  // In a uniform cell the nodes reached by a box follow from its position. In
  // other cells, and for convected domains, the weights are needed.
  template <int dim>
  void
  NodalGaps<dim>::add_segment(const State<dim> &state, const Segment &segment)
  {
    const Cell<dim> &cell = state.grid.cells()[segment.cell];
    if (cell.uniform &&
        state.constants.box_shape.rule != BoxRule::convected_domain)
      {
        add_to_patch(state, segment);
        return;
      }
    std::vector<NodeWeight<dim>> weights;
    look_around(cell);
    for (unsigned int p = segment.begin; p < segment.end; ++p)
      {
        find_of_point(load_place(state.points, state.points.position, p),
                      cell.size * half_lengths(state, cell, p));
        weights_of_point(state.points,
                         state.grid,
                         state.constants.box_shape,
                         segment.cell,
                         p,
                         weights);
        for (const NodeWeight<dim> &weight : weights)
          if (weight.value > 0 && is_open_[weight.node])
            lower(weight.node);
      }
  }



  /// Lower the gaps at the nodes of the patch which are still open. Stop when
  /// all are closed: soil at rest closes its nodes with its first points.
  template <int dim>
  void
  NodalGaps<dim>::add_to_patch(const State<dim> &state, const Segment &segment)
  {
    const Cell<dim> &cell = state.grid.cells()[segment.cell];
    PatchEntries     open = entries_with(is_open_, cell);
    if (!open)
      return;
    look_around(cell);
    const auto plane = plane_of_cell_ && near_cell_.size() == 1
                         ? plane_of_cell_(segment.cell)
                         : std::nullopt;
    std::pair<const SurfaceTable<dim> *, unsigned int> table(nullptr, 0);
    if (table_of_cell_ && near_cell_.size() == 1 && !plane)
      table = table_of_cell_(segment.cell);
    for (unsigned int p = segment.begin; p < segment.end && open; ++p)
      {
        const Tensor<1, dim> half = half_lengths(state, cell, p);
        const Point<dim> x = load_place(state.points, state.points.position, p);
        PatchEntries     left = open & entries_in_reach(cell, x, half);
        if (left == 0)
          continue;
        if (table.first)
          find_of_point(*table.first, table.second, x, cell.size * half);
        else if (!plane ||
                 !is_in_contact(*plane, cell.size, x, cell.size * half))
          find_of_point(x, cell.size * half);
        for (; left != 0; left &= left - 1)
          {
            const unsigned int k = __builtin_ctzll(left);
            lower(cell.patch[k]);
            if (!is_open_[cell.patch[k]])
              open &= ~(PatchEntries(1) << k);
          }
      }
  }



  template class NodalGaps<2>;
  template class NodalGaps<3>;
} // namespace talus
