#include <talus/transfer/block.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>

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



  template <int dim>
  void
  BlockWalk<dim>::take_piece(Block<dim>        &block,
                             const Segment     &segment,
                             const unsigned int n)
  {
    using Number             = Simd<simd_width>;
    const Cell<dim>   &cell  = grid_.cells()[segment.cell];
    const unsigned int begin = block.size, end = begin + n;
    fetch_cell_ahead();
    block.pieces[block.n_pieces++] = {begin, end, cell.patch.data()};
    // Whole registers: what goes beyond the end is overwritten by the next
    // piece. One is mostly enough.
#pragma GCC unroll 1
    for (unsigned int k = begin; k < end; k += simd_width)
      for (unsigned int d = 0; d < dim; ++d)
        store(&block.cell_lower[d][k], Number(cell.lower[d]));
    block.size = end;
  }



  namespace
  {
    /// Points of a block, a bit for each.
    using Bits = std::uint64_t;

    /// Boxes along one axis, in units of the cell, from its lower face on.
    template <int dim>
    struct Boxes
    {
      alignas(64) typename Block<dim>::RowWithSpare centre, half;
      /// Boxes that reach beyond the lower and the upper face of their cell.
      Bits reach_below = 0, reach_above = 0;
    };



    template <int dim>
    void
    find_boxes(const Block<dim>                    &block,
               const PointsView<dim, const double> &points,
               const BoxShape                      &shape,
               Boxes<dim> (&boxes)[dim])
    {
      using Number              = Simd<simd_width>;
      const Number inverse_size = 1. / block.cell_size;
      // Whole registers: what lies behind the last point of the block is
      // computed, too, from whatever is there, and never used.
      for (unsigned int k = 0; k < block.size; k += simd_width)
#pragma GCC unroll 3
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int p = block.begin + k;
            const auto x = load<Number>(points.data(points.position, d) + p);
            const auto lower  = load<Number>(&block.cell_lower[d][k]);
            const auto centre = (x - lower) * inverse_size;
            const auto half =
              half_length_in_cells<dim>(points, shape, d, p, inverse_size);
            store(&boxes[d].centre[k], centre);
            store(&boxes[d].half[k], half);
            boxes[d].reach_below |= Bits((centre < half).bits()) << k;
            boxes[d].reach_above |= Bits((centre + half > 1.).bits()) << k;
          }
    }



    /// A box inside its cell has weights at the nodes of the cell, and none at
    /// the one below nor at the one above: it may go with those that reach below
    /// as well as with those that do not. Take the side that leaves most
    /// points of the cell with the same nodes: below if any box must. Returns,
    /// of @p these points, those whose nodes begin below the cell.
    template <int dim>
    Bits
    begin_below(const Boxes<dim> &boxes, const Bits these)
    {
      return (boxes.reach_below & these) != 0 ? these & ~boxes.reach_above : 0;
    }



    /// Part @p these points of a cell into runs.
    template <int dim>
    void
    add_runs(Block<dim>                               &block,
             const unsigned int                       *patch,
             const Bits                                these,
             const std::array<Bits, std::size_t(dim)> &below)
    {
      for (unsigned int corner = 0; corner < power(2, dim); ++corner)
        {
          Bits         points = these;
          unsigned int first  = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const bool is_above = (corner >> d) & 1;
              points &= (is_above ? ~below[d] : below[d]);
              first += is_above * power(4, d);
            }
          if (points != 0)
            block.runs[block.n_runs++] = {points, patch + first};
        }
    }



    /// Part the points of each cell into runs. On return @p boxes has in
    /// reach_below the points whose nodes begin below the cell.
    template <int dim>
    void
    find_runs(Block<dim> &block, Boxes<dim> (&boxes)[dim])
    {
      block.n_runs = 0;
      std::array<Bits, dim> below{};
      for (unsigned int i = 0; i < block.n_pieces; ++i)
        {
          const auto &piece = block.pieces[i];
          const Bits  all   = (~Bits(0) >> (64 - (piece.end - piece.begin)))
                           << piece.begin;
          std::array<Bits, dim> below_here;
          bool                  is_one_run = true;
          unsigned int          first      = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              below_here[d] = begin_below(boxes[d], all);
              below[d] |= below_here[d];
              is_one_run =
                is_one_run & (below_here[d] == 0 || below_here[d] == all);
              first += (below_here[d] == 0) * power(4, d);
            }
          if (is_one_run)
            block.runs[block.n_runs++] = {all, piece.patch + first};
          else
            add_runs(block, piece.patch, all, below_here);
        }
      for (unsigned int d = 0; d < dim; ++d)
        boxes[d].reach_below = below[d];
    }
  } // namespace



  template <int dim>
  void
  BlockWalk<dim>::compute_weights(Block<dim> &block) const
  {
    Boxes<dim> boxes[dim];
    find_boxes(block, points_.view(), shape_, boxes);
    find_runs(block, boxes);

    using Number              = Simd<simd_width>;
    const Number inverse_size = 1. / block.cell_size;
    for (unsigned int k = 0; k < block.size; k += simd_width)
#pragma GCC unroll 3
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto below = Number::Mask::of_bits(boxes[d].reach_below >> k);
          const auto w     = axis_weights(load<Number>(&boxes[d].centre[k]) +
                                        select(below, Number(1.), Number(0.)),
                                      load<Number>(&boxes[d].half[k]));
          for (unsigned int i = 0; i < 3; ++i)
            {
              store(&block.value[d][i][k], w.value[i]);
              store(&block.gradient[d][i][k], w.gradient[i] * inverse_size);
            }
        }
  }



  template <int dim>
  bool
  BlockWalk<dim>::next(Block<dim> &block)
  {
    block.size           = 0;
    block.n_pieces       = 0;
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
