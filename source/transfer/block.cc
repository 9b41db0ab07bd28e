// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/block_walk.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>
#include <type_traits>

namespace talus
{
  namespace
  {
    /// Points of a block by the extent of their boxes along an axis: bit
    /// `below` is set if the box reaches beyond the lower face of the cell, bit
    /// `inside_above` if the box does not reach the upper face.
    struct Reach
    {
      PointsOfBlock below = 0, inside_above = 0;
    };



    /// Return the points of @p these whose three nodes begin below the cell. A
    /// box inside the cell has zero weight at the nodes below and above the
    /// cell, so it may join boxes that reach below or boxes that do not. Choose
    /// the side that gives most points of the cell the same nodes: below if any
    /// box reaches below.
    inline PointsOfBlock
    begin_below(const Reach &reach, const PointsOfBlock these)
    {
      return (reach.below & these) != 0 ? these & reach.inside_above : 0;
    }



    /// Move the points that reach into a cell of another size from @p these to
    /// the irregular points of the block; the cell is not uniform. Return the
    /// patch for the remaining points.
    template <int dim>
    const unsigned int *
    split_off_irregular_points(Block<dim>                           &block,
                               const typename Block<dim>::CellRange &range,
                               const Reach (&reach)[dim],
                               PointsOfBlock &these)
    {
      const Cell<dim> &cell = *range.cell_data;
      PointsOfBlock    irregular_points{};
      for (unsigned int d = 0; d < dim; ++d)
        {
          if (!((cell.sides_of_same_size >> (2 * d)) & 1))
            irregular_points |= reach[d].below;
          if (!((cell.sides_of_same_size >> (2 * d + 1)) & 1))
            irregular_points |= ~reach[d].inside_above;
        }
      irregular_points &= these;
      these &= ~irregular_points;
      for_each_bit(irregular_points, [&](const unsigned int k) {
        block.irregular_points[block.n_irregular_points++] = {k, range.cell};
      });
      constexpr unsigned int own   = (power(4, dim) - 1) / 3; // (1, 1, 1)
      auto                  &patch = block.patches[block.n_patches++];
      for (unsigned int i = 0; i < patch.size(); ++i)
        {
          const unsigned int node = cell.patch[i];
          const bool is_valid = (node != dealii::numbers::invalid_unsigned_int);
          patch[i]            = (is_valid ? node : cell.patch[own]);
        }
      return patch.data();
    }



    /// Add a group of @p points, unless empty. Along axis d the nodes begin at
    /// the lower face of the cell if bit d of @p above is set, otherwise one
    /// node below.
    template <int dim>
    void
    add_group(Block<dim>         &block,
              const unsigned int *patch,
              const PointsOfBlock points,
              const unsigned int  above)
    {
      if (points == 0)
        return;
      auto &group  = block.groups[block.n_groups++];
      group.points = points;
      group.patch  = patch;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = (above >> d) & 1;
          group.patch += i * power(4, d);
          group.weights[d] = &block.weights[d][i * Block<dim>::n_points];
        }
    }



    /// Split the points @p these of a cell into groups.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    add_groups(Block<dim>         &block,
               const unsigned int *patch,
               const Reach (&reach)[dim],
               const PointsOfBlock these)
    {
      PointsOfBlock below[dim];
      bool          is_one_run = true;
      unsigned int  above      = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          below[d]   = begin_below(reach[d], these);
          is_one_run = is_one_run & (below[d] == 0 || below[d] == these);
          above |= (below[d] == 0) << d;
        }
      if (is_one_run)
        add_group(block, patch, these, above);
      else
        for (unsigned int corner = 0; corner < power(2, dim); ++corner)
          {
            PointsOfBlock points = these;
            for (unsigned int d = 0; d < dim; ++d)
              points &= ((corner >> d) & 1 ? ~below[d] : below[d]);
            add_group(block, patch, points, corner);
          }
    }



    /// Split the points of each cell into groups and irregular points. Groups
    /// make the transfer fast: most points of a cell have weights at the same
    /// 3^dim nodes. The contributions of a group, four to six points on
    /// average, are summed in registers and written to memory once, whereas a
    /// single point would load and store 3^dim records.
    /// Groups are found by bit operations, a bit per point and face, without a
    /// branch per point that the processor would have to predict.
    template <int dim>
    void
    find_groups(Block<dim> &block, const Reach (&reach)[dim])
    {
      block.n_groups = block.n_irregular_points = block.n_patches = 0;
      for (unsigned int i = 0; i < block.n_cell_ranges; ++i)
        {
          const auto   &range = block.cell_ranges[i];
          PointsOfBlock these =
            (~PointsOfBlock(0) >> (64 - (range.end - range.begin)))
            << range.begin;
          const unsigned int *patch = range.patch;
          if (!range.cell_data->uniform)
            patch = split_off_irregular_points(block, range, reach, these);
          add_groups(block, patch, reach, these);
        }
    }



    /// Make every point of the block irregular: a group requires weights that
    /// are products of factors along the axes. Convected domains have no such
    /// factors.
    template <int dim>
    void
    make_all_irregular(Block<dim> &block)
    {
      block.n_groups = block.n_irregular_points = block.n_patches = 0;
      for (unsigned int i = 0; i < block.n_cell_ranges; ++i)
        for (unsigned int k = block.cell_ranges[i].begin;
             k < block.cell_ranges[i].end;
             ++k)
          block.irregular_points[block.n_irregular_points++] = {
            k, block.cell_ranges[i].cell};
    }


    /// Compute the weights of all points of the block. Along each axis a box
    /// has weights at four nodes around its cell; a group uses three. All four
    /// are computed for all points without a branch, from two integrals
    /// (axis_weights()). The signs of the distances of the box from the faces
    /// later select the three nodes; null as @p reach leaves them out. Weights
    /// are computed in both sweeps of a step, because storing 16 doubles per
    /// point (24 in 3-D) would cost more memory traffic.
    template <int dim, typename OptionalReach>
    TALUS_ALWAYS_INLINE void
    compute_axis_weights(const PointsView<dim, const double> &points,
                         const BoxShape                      &shape,
                         Block<dim>                          &block,
                         const OptionalReach                 &reach)
    {
      using Number                        = Simd<simd_width>;
      constexpr unsigned int n            = Block<dim>::n_points;
      const Number           inverse_size = 1. / block.cell_size;
      // Whole registers: entries behind the last point of the block are
      // computed, too, and never used.
      for (unsigned int k = 0; k < block.size; k += simd_width)
#pragma GCC unroll 3
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int p = block.begin + k;
            const auto x = load<Number>(points.data(points.position, d) + p);
            const auto lower = load<Number>(&block.cell_lower[d][k]);
            const auto half =
              half_length_in_cells<dim>(points, shape, d, p, inverse_size);
            const auto    w  = axis_weights((x - lower) * inverse_size, half);
            double *const to = &block.weights[d][k];
            for (unsigned int i = 0; i < 4; ++i)
              {
                store(to + n * i, w.value[i]);
                store(to + Block<dim>::begin_of_gradient + n * i,
                      w.gradient[i]);
              }
            if constexpr (!std::is_null_pointer_v<OptionalReach>)
              {
                reach[d].below |= PointsOfBlock(w.lower_end.sign_bits()) << k;
                reach[d].inside_above |= PointsOfBlock(w.upper_end.sign_bits())
                                         << k;
              }
          }
    }
  } // namespace



  template <int dim>
  void
  BlockWalk<dim>::compute_weights(Block<dim> &block) const
  {
    const PointsView<dim, const double> points = points_.view();
    if (restore_ != nullptr && restore_->restore(block))
      {
        compute_axis_weights<dim>(points, shape_, block, nullptr);
        return;
      }
    Reach reach[dim];
    compute_axis_weights<dim>(points, shape_, block, &reach[0]);
    find_groups(block, reach);
    if (store_ != nullptr)
      store_->store(block);
  }



  namespace
  {
    /// Prefetch a cell. (GCC drops the prefetches unless the function is
    /// inlined.)
    template <int dim>
    TALUS_ALWAYS_INLINE void
    prefetch(const Cell<dim> &cell)
    {
      constexpr int     for_reading = 0, into_second_level_cache = 2;
      const auto *const bytes = reinterpret_cast<const char *>(&cell);
      for (std::size_t i = 0; i < sizeof(Cell<dim>); i += alignof(Cell<dim>))
        __builtin_prefetch(bytes + i, for_reading, into_second_level_cache);
    }
  } // namespace



  // A block spans several cells, since a cell has too few points to fill
  // registers. A block has one body, since loads differ between bodies, and one
  // cell size, since all lengths are divided by the cell size. A full block
  // ends in the middle of a cell.
  template <int dim>
  bool
  BlockWalk<dim>::next(Block<dim> &block)
  {
    const std::vector<Segment> &segments = points_.segments();
    const Cell<dim> *const      cells    = grid_.cells().data();
    unsigned int                size = 0, n_cell_ranges = 0;
    for (; segment_ < last_segment_; ++segment_)
      {
        const Segment   &segment = segments[segment_];
        const Cell<dim> &cell    = cells[segment.cell];
        // The previous block may have ended within this segment.
        if (n_cell_ranges == 0)
          {
            point_          = std::max(point_, segment.begin);
            block.begin     = point_;
            block.body      = segment.body;
            block.cell_size = cell.size;
          }
        else if (segment.body != block.body || cell.size != block.cell_size)
          break;
        // The first phase of the next batch would wait for the data of each
        // cell: prefetch each cell one batch ahead.
        if (const std::size_t ahead = std::size_t(segment_) + n_segments_;
            ahead < segments.size())
          prefetch(cells[segments[ahead].cell]);

        const unsigned int end =
          std::min(size + (segment.end - point_), Block<dim>::n_points);
        block.cell_ranges[n_cell_ranges++] = {
          size, end, segment.cell, &cell, cell.patch.data()};
        // Whole registers: values beyond the end are overwritten by the next
        // range. One register is mostly enough.
#pragma GCC unroll 1
        for (unsigned int k = size; k < end; k += simd_width)
          for (unsigned int d = 0; d < dim; ++d)
            store(&block.cell_lower[d][k], Simd<simd_width>(cell.lower[d]));
        point_ += end - size;
        size = end;
        if (size == Block<dim>::n_points)
          {
            segment_ += (point_ == segment.end);
            break;
          }
      }
    block.size          = size;
    block.n_cell_ranges = n_cell_ranges;
    if (size == 0)
      return false;
    if (shape_.rule == BoxRule::convected_domain)
      make_all_irregular(block);
    else
      compute_weights(block);
    return true;
  }



  template class BlockWalk<2>;
  template class BlockWalk<3>;
} // namespace talus
