#include <talus/transfer/block.h>

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
    /// Let each of eight pointers point @p by entries, a whole number, further.
    /// As numbers of a register: GCC takes pointers out of it one by one.
    inline void
    advance(const unsigned int **pointers, const Lanes &by)
    {
      static_assert(sizeof(Lanes) == n_lanes * sizeof(unsigned int *));
      constexpr LaneMask size    = LaneMask{} + sizeof(unsigned int);
      LaneMask           address = {};
      std::memcpy(&address, pointers, sizeof(address));
      address += size * __builtin_convertvector(by, LaneMask);
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
    for (unsigned int k = begin; k < end; k += n_lanes)
      {
        for (unsigned int d = 0; d < dim; ++d)
          store(&block.cell_lower[d][k], broadcast<Lanes>(cell.lower[d]));
        for (unsigned int i = 0; i < n_lanes; ++i)
          block.nodes[k + i] = cell.patch.data();
      }
    block.size = end;
  }



  template <int dim>
  void
  BlockWalk<dim>::compute_weights(Block<dim> &block) const
  {
    const double inverse_size = 1. / block.cell_size;
    // Whole lanes: what lies behind the last point of the block is computed,
    // too, from whatever is there, and never used.
    for (unsigned int k = 0; k < block.size; k += n_lanes)
      {
        const unsigned int p = block.begin + k;
        Lanes              first{};
        for (unsigned int d = 0; d < dim; ++d)
          {
            const Lanes x = load<Lanes>(points_.data(points_.position, d) + p);
            const Lanes lower = load<Lanes>(&block.cell_lower[d][k]);
            const Lanes half  = half_length_in_cells<dim>(
              points_, shape_, d, p, broadcast<Lanes>(inverse_size));
            const auto w = axis_weights((x - lower) * inverse_size, half);
            first += w.first * static_cast<double>(power(4, d));
            for (unsigned int i = 0; i < 3; ++i)
              {
                store(&block.value[d][i][k], w.value[i]);
                store(&block.gradient[d][i][k], w.gradient[i] * inverse_size);
              }
          }
        advance(&block.nodes[k], first);
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
