#include <talus/transfer/block.h>

#include <algorithm>

namespace talus
{
  template <int dim>
  void
  BlockWalk<dim>::take_piece(Block<dim>        &block,
                             const Segment     &segment,
                             const unsigned int n)
  {
    const Cell<dim>   &cell  = grid_.cells()[segment.cell];
    const unsigned int begin = block.size, end = begin + n;
    block.patch_of_cell[block.n_cells++] = cell.patch.data();
    // Whole registers: what goes beyond the end is overwritten by the next
    // piece.
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int k = begin; k < end; k += n_lanes)
        store(&block.cell_lower[d][k], broadcast<Lanes>(cell.lower[d]));
    for (unsigned int k = begin; k < end; ++k)
      block.patch[k] = cell.patch.data();
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
        store_as_integers(&block.first_node[k], first);
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
