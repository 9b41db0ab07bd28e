#ifndef talus_transfer_block_h
#define talus_transfer_block_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/transfer/box_shape.h>

#include <array>
#include <cstdint>

namespace talus
{
  /// Points of a block in one cell with weights at the same 3^dim nodes.
  struct Run
  {
    std::uint64_t points; ///< bit k: point k of the block
    /// The first of the nodes in the patch of the cell, see Cell::patch; 4
    /// nodes of the patch are a row.
    const unsigned int *patch;
  };



  /// Up to n_points consecutive points of one body, in uniform cells of one
  /// size, with what the kernels need of them side by side: small enough for the
  /// first-level cache, large enough that loops over points fill the registers
  /// although a cell may have only a few.
  template <int dim>
  struct Block
  {
    static constexpr unsigned int n_points = 64; ///< bits of Run::points
    /// What is filled a register at a time may go beyond the last point.
    static constexpr unsigned int n_with_spare =
      n_points + Points<dim>::n_spare;
    using Row          = std::array<double, n_points>;
    using RowWithSpare = std::array<double, n_with_spare>;

    /// The points of a cell.
    struct Piece
    {
      unsigned int        begin, end; ///< among those of the block
      const unsigned int *patch;      ///< Cell::patch
    };

    unsigned int begin = 0; ///< first point
    unsigned int size  = 0;
    unsigned int body  = 0;
    double       cell_size;

    unsigned int                n_pieces = 0;
    std::array<Piece, n_points> pieces;
    unsigned int                n_runs = 0;
    std::array<Run, n_points>   runs;

    /// Corner of the cell of each point, m.
    alignas(64) std::array<RowWithSpare, dim> cell_lower;

    alignas(64) std::array<std::array<Row, 3>, dim> value;
    alignas(64) std::array<std::array<Row, 3>, dim> gradient; ///< 1/m
  };



  /// Walks over the points of a batch in blocks; points in cells that are not
  /// uniform are passed over.
  template <int dim>
  class BlockWalk
  {
  public:
    BlockWalk(const Points<dim> &points,
              const Batch       &batch,
              const Grid<dim>   &grid,
              const BoxShape    &shape)
      : points_(points)
      , grid_(grid)
      , shape_(shape)
      , segment_(batch.first_segment)
      , last_segment_(batch.last_segment)
      , n_segments_(batch.last_segment - batch.first_segment)
    {}

    /// Fill @p block with the next points; false if there are none left.
    bool
    next(Block<dim> &block);

  private:
    void
    fetch_cell_ahead() const;
    void
    take_piece(Block<dim> &block, const Segment &segment, unsigned int n);
    void
    compute_weights(Block<dim> &block) const;

    const Points<dim> &points_;
    const Grid<dim>   &grid_;
    const BoxShape    &shape_;
    unsigned int       segment_;
    unsigned int       last_segment_;
    unsigned int       n_segments_; ///< of the batch
    unsigned int       taken_ = 0;  ///< points of the segment
  };



  /// Ask for the memory of all nodes near the block, which begins at
  /// address(node). On a large mesh it is not in the cache, and the machine,
  /// which sees ahead of loops over points, does not see which nodes will be
  /// next: without this a step on 640 000 points takes a quarter longer.
  template <int dim, typename Address>
  TALUS_ALWAYS_INLINE void
  prefetch_nodes(const Block<dim> &block, const Address &address)
  {
    for (unsigned int c = 0; c < block.n_pieces; ++c)
      for (unsigned int i = 0; i < power(4, dim); ++i)
        __builtin_prefetch(address(block.pieces[c].patch[i]));
  }



  /// Call action(k) for each point of a run.
  template <typename Action>
  TALUS_ALWAYS_INLINE void
  for_each_point(const Run &run, const Action &action)
  {
    for (std::uint64_t left = run.points; left != 0; left &= left - 1)
      action(__builtin_ctzll(left));
  }
} // namespace talus

#endif
