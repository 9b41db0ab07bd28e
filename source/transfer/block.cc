#include <talus/transfer/block.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>
#include <cstring>

namespace talus
{
  /// Ask for the cell of that segment of the next batch whose turn comes as long
  /// after its begin as this segment's: the first phase of that batch would else
  /// wait for each of its cells. (Not inlined, GCC leaves it out.)
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline void
  BlockWalk<dim>::fetch_cell_ahead() const
  {
    constexpr int     for_reading = 0, into_second_level_cache = 2;
    constexpr auto    line     = alignof(Cell<dim>);
    const auto       &segments = points_.segments();
    const std::size_t ahead    = std::size_t(segment_) + n_segments_;
    if (ahead >= segments.size())
      return;
    const auto *const cell =
      reinterpret_cast<const char *>(&grid_.cells()[segments[ahead].cell]);
    for (std::size_t i = 0; i < sizeof(Cell<dim>); i += line)
      __builtin_prefetch(cell + i, for_reading, into_second_level_cache);
  }



  namespace
  {
    using Number = Simd<simd_width>;

    /// Let pointer i, a number of a register, point by entries further where
    /// entry i of @p which is false.
    template <typename Mask>
    TALUS_ALWAYS_INLINE void
    advance_unless(const unsigned int **pointers,
                   const Mask          &which,
                   const unsigned int   by)
    {
      static_assert(sizeof(Mask) == simd_width * sizeof(unsigned int *));
      using Addresses       = typename Mask::Register;
      const Addresses bytes = Addresses{} + by * sizeof(unsigned int);
      Addresses       address;
      std::memcpy(&address, pointers, sizeof(address));
      address += ~which.value & bytes;
      std::memcpy(pointers, &address, sizeof(address));
    }
  } // namespace



  template <int dim>
  void
  BlockWalk<dim>::take_piece(Block<dim>        &block,
                             const Segment     &segment,
                             const unsigned int n)
  {
    const Cell<dim>   &cell  = grid_.cells()[segment.cell];
    const unsigned int begin = block.size, end = begin + n;
    fetch_cell_ahead();
    block.patch_of_cell[block.n_cells++] = cell.patch.data();
    // Whole registers: what goes beyond the end is overwritten by the next
    // piece. One is mostly enough.
#pragma GCC unroll 1
    for (unsigned int k = begin; k < end; k += simd_width)
      {
        for (unsigned int d = 0; d < dim; ++d)
          store(&block.cell_lower[d][k], Number(cell.lower[d]));
        for (unsigned int i = 0; i < simd_width; ++i)
          block.nodes[k + i] = cell.patch.data();
      }
    block.size = end;
  }



  template <int dim>
  void
  BlockWalk<dim>::compute_weights(Block<dim> &block) const
  {
    const auto   points       = points_.view();
    const Number inverse_size = 1. / block.cell_size;
    // Whole registers: what lies behind the last point of the block is
    // computed, too, from whatever is there, and never used.
    for (unsigned int k = 0; k < block.size; k += simd_width)
      {
        const unsigned int p = block.begin + k;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto x = load<Number>(points.data(points.position, d) + p);
            const auto lower = load<Number>(&block.cell_lower[d][k]);
            const auto half =
              half_length_in_cells<dim>(points, shape_, d, p, inverse_size);
            const auto w = axis_weights((x - lower) * inverse_size, half);
            advance_unless(&block.nodes[k], w.begins_below, power(4, d));
            for (unsigned int i = 0; i < 3; ++i)
              {
                store(&block.value[d][i][k], w.value[i]);
                store(&block.gradient[d][i][k], w.gradient[i] * inverse_size);
              }
          }
      }
  }



  template <int dim>
  bool
  BlockWalk<dim>::next(Block<dim> &block)
  {
    block.size           = 0;
    block.n_cells        = 0;
    const auto &segments = points_.segments();
    for (; segment_ < last_segment_; ++segment_, taken_ = 0)
      {
        const Segment   &segment = segments[segment_];
        const Cell<dim> &cell    = grid_.cells()[segment.cell];
        if (block.size == 0)
          {
            if (!cell.uniform)
              continue;
            block.begin     = segment.begin + taken_;
            block.body      = segment.body;
            block.cell_size = cell.size;
          }
        else if (!cell.uniform || segment.body != block.body ||
                 cell.size != block.cell_size)
          break;
        const unsigned int left = segment.end - segment.begin - taken_;
        const unsigned int room = Block<dim>::n_points - block.size;
        take_piece(block, segment, std::min(left, room));
        if (left >= room)
          {
            taken_ += room;
            if (left == room)
              {
                ++segment_;
                taken_ = 0;
              }
            break;
          }
      }
    if (block.size == 0)
      return false;
    compute_weights(block);
    return true;
  }



  template class BlockWalk<2>;
  template class BlockWalk<3>;
} // namespace talus
