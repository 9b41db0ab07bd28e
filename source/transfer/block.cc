// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/block.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>

namespace talus
{
  namespace
  {
    /// Of a block, which boxes reach beyond the lower face of their cell along
    /// an axis, and which do not reach its upper one.
    struct Reach
    {
      PointsOfBlock below = 0, inside_above = 0;
    };



    /// A box inside its cell has weights at the nodes of the cell, and none at
    /// the one below nor at the one above: it may go with those that reach
    /// below as well as with those that do not. Take the side that leaves most
    /// points of the cell with the same nodes: below if any box must. Returns,
    /// of @p these points, those whose nodes begin below the cell.
    inline PointsOfBlock
    begin_below(const Reach &reach, const PointsOfBlock these)
    {
      return (reach.below & these) != 0 ? these & reach.inside_above : 0;
    }



    /// Take out of @p these points of a cell that is not uniform those that
    /// reach into a cell of another size. Returns the patch for the others.
    template <int dim>
    const unsigned int *
    part_from_outsiders(Block<dim>                       &block,
                        const typename Block<dim>::Piece &piece,
                        const Reach (&reach)[dim],
                        PointsOfBlock &these)
    {
      const Cell<dim> &cell = *piece.cell_data;
      PointsOfBlock    outsiders{};
      for (unsigned int d = 0; d < dim; ++d)
        {
          if (!((cell.sides_of_same_size >> (2 * d)) & 1))
            outsiders |= reach[d].below;
          if (!((cell.sides_of_same_size >> (2 * d + 1)) & 1))
            outsiders |= ~reach[d].inside_above;
        }
      outsiders &= these;
      these &= ~outsiders;
      for_each_bit(outsiders, [&](const unsigned int k) {
        block.outsiders[block.n_outsiders++] = {k, piece.cell};
      });
      constexpr unsigned int own = (power(4, dim) - 1) / 3; // one up each axis
      auto                  &patch = block.patches[block.n_patches++];
      for (unsigned int i = 0; i < patch.size(); ++i)
        {
          const unsigned int node = cell.patch[i];
          const bool is_valid = (node != dealii::numbers::invalid_unsigned_int);
          patch[i]            = (is_valid ? node : cell.patch[own]);
        }
      return patch.data();
    }



    /// Add a run of @p points, if there are any, whose nodes begin below the
    /// cell along the axes where bit d of @p above is not set.
    template <int dim>
    void
    add_run(Block<dim>         &block,
            const unsigned int *patch,
            const PointsOfBlock points,
            const unsigned int  above)
    {
      if (points == 0)
        return;
      auto &run  = block.runs[block.n_runs++];
      run.points = points;
      run.patch  = patch;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int i = (above >> d) & 1;
          run.patch += i * power(4, d);
          run.weights[d] = &block.weights[d][i * Block<dim>::n_points];
        }
    }



    /// Part @p these points of a cell into runs.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    add_runs(Block<dim>         &block,
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
        add_run(block, patch, these, above);
      else
        for (unsigned int corner = 0; corner < power(2, dim); ++corner)
          {
            PointsOfBlock points = these;
            for (unsigned int d = 0; d < dim; ++d)
              points &= ((corner >> d) & 1 ? ~below[d] : below[d]);
            add_run(block, patch, points, corner);
          }
    }



    /// Part the points of each cell into runs and outsiders.
    /// This is what makes the transfer fast: most points of a cell have weights
    /// at the same 3^dim nodes. As a run, of four to six points on average,
    /// they are summed up in registers and memory is touched once for all of
    /// them, where each point by itself would load and store 3^dim records
    /// (doc/performance.md). Which points go together is a matter of bits:
    /// reach has one bit per point and face, so there is no branch per point
    /// that the machine would have to guess.
    template <int dim>
    void
    find_runs(Block<dim> &block, const Reach (&reach)[dim])
    {
      block.n_runs = block.n_outsiders = block.n_patches = 0;
      for (unsigned int i = 0; i < block.n_pieces; ++i)
        {
          const auto   &piece = block.pieces[i];
          PointsOfBlock these =
            (~PointsOfBlock(0) >> (64 - (piece.end - piece.begin)))
            << piece.begin;
          const unsigned int *patch = piece.cell_data->patch.data();
          if (!piece.cell_data->uniform)
            patch = part_from_outsiders(block, piece, reach, these);
          add_runs(block, patch, reach, these);
        }
    }



    /// Domains that are no boxes have weights that are no products.
    /// A run takes for granted that a weight is a product of factors along the
    /// axes.
    template <int dim>
    void
    make_all_outsiders(Block<dim> &block)
    {
      block.n_runs = block.n_outsiders = block.n_patches = 0;
      for (unsigned int i = 0; i < block.n_pieces; ++i)
        for (unsigned int k = block.pieces[i].begin; k < block.pieces[i].end;
             ++k)
          block.outsiders[block.n_outsiders++] = {k, block.pieces[i].cell};
    }
  } // namespace



  // Along each axis a box has weights at four nodes around its cell, of which a
  // run takes three. All four are computed, for all points at once and without
  // a branch, from two integrals (axis_weights()); which three count is decided
  // later by the signs of how far the box reaches beyond the faces. Weights are
  // computed in both sweeps of a step: kept from one to the next, 16 doubles
  // per point (24 in 3-D) would travel to memory and back.
  template <int dim>
  void
  BlockWalk<dim>::compute_weights(Block<dim> &block) const
  {
    using Number                        = Simd<simd_width>;
    constexpr unsigned int n            = Block<dim>::n_points;
    const auto             points       = points_.view();
    const Number           inverse_size = 1. / block.cell_size;
    Reach                  reach[dim];
    // Whole registers: what lies behind the last point of the block is
    // computed, too, from whatever is there, and never used.
    for (unsigned int k = 0; k < block.size; k += simd_width)
#pragma GCC unroll 3
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int p = block.begin + k;
          const auto x     = load<Number>(points.data(points.position, d) + p);
          const auto lower = load<Number>(&block.cell_lower[d][k]);
          const auto half =
            half_length_in_cells<dim>(points, shape_, d, p, inverse_size);
          const auto    w  = axis_weights((x - lower) * inverse_size, half);
          double *const to = &block.weights[d][k];
          for (unsigned int i = 0; i < 4; ++i)
            {
              store(to + n * i, w.value[i]);
              store(to + Block<dim>::begin_of_gradient + n * i, w.gradient[i]);
            }
          reach[d].below |= PointsOfBlock(w.lower_end.sign_bits()) << k;
          reach[d].inside_above |= PointsOfBlock(w.upper_end.sign_bits()) << k;
        }
    find_runs(block, reach);
  }



  namespace
  {
    /// Ask for a cell. (Not inlined, GCC leaves it out.)
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



  // A block goes across cells, since a cell has too few points to fill
  // registers; but not across bodies, whose loads differ, nor across sizes of
  // cells, which all lengths are divided by. It ends in the middle of a cell if
  // it is full.
  template <int dim>
  bool
  BlockWalk<dim>::next(Block<dim> &block)
  {
    const std::vector<Segment> &segments = points_.segments();
    const Cell<dim> *const      cells    = grid_.cells().data();
    unsigned int                size = 0, n_pieces = 0;
    for (; segment_ < last_segment_; ++segment_)
      {
        const Segment   &segment = segments[segment_];
        const Cell<dim> &cell    = cells[segment.cell];
        // The last block may have ended within this segment.
        if (n_pieces == 0)
          {
            point_          = std::max(point_, segment.begin);
            block.begin     = point_;
            block.body      = segment.body;
            block.cell_size = cell.size;
          }
        else if (segment.body != block.body || cell.size != block.cell_size)
          break;
        // The first phase of the next batch would else wait for each of its
        // cells: each one is asked for when its turn is a batch later.
        if (const std::size_t ahead = std::size_t(segment_) + n_segments_;
            ahead < segments.size())
          prefetch(cells[segments[ahead].cell]);

        const unsigned int end =
          std::min(size + (segment.end - point_), Block<dim>::n_points);
        block.pieces[n_pieces++] = {size, end, segment.cell, &cell};
        // Whole registers: what goes beyond the end is overwritten by the next
        // piece. One is mostly enough.
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
    block.size     = size;
    block.n_pieces = n_pieces;
    if (size == 0)
      return false;
    if (shape_.rule == BoxRule::convected_domain)
      make_all_outsiders(block);
    else
      compute_weights(block);
    return true;
  }



  template class BlockWalk<2>;
  template class BlockWalk<3>;
} // namespace talus
