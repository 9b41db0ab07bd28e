#ifndef talus_transfer_block_h
#define talus_transfer_block_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/transfer/box_rule.h>

namespace talus
{
  /// Up to n_points consecutive points of one body, in uniform cells of one
  /// size, with what the kernels need of them side by side: small enough for the
  /// first-level cache, large enough that loops over points fill the registers
  /// although a cell may have only a few.
  template <int dim>
  struct Block
  {
    static constexpr unsigned int n_points = 64;
    /// What is filled a register at a time may go beyond the last point.
    static constexpr unsigned int n_with_spare =
      n_points + Points<dim>::n_spare;
    using Row = std::array<double, n_points>;

    unsigned int begin   = 0; ///< first point
    unsigned int size    = 0;
    unsigned int n_cells = 0;
    unsigned int body    = 0;
    double       cell_size;

    /// Nodes around each of the cells, see Cell::patch.
    std::array<const unsigned int *, n_points> patch_of_cell;

    /// Corner of the cell of each point, m.
    alignas(64) std::array<std::array<double, n_with_spare>, dim> cell_lower;
    /// The first of the 3^dim nodes of its cell's patch at which a point has
    /// weights; 4 nodes of the patch are a row.
    alignas(64) std::array<const unsigned int *, n_with_spare> nodes;

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
    for (unsigned int c = 0; c < block.n_cells; ++c)
      for (unsigned int i = 0; i < power(4, dim); ++i)
        __builtin_prefetch(address(block.patch_of_cell[c][i]));
  }



  /// Call action(begin, end) for the points of the block that follow each other
  /// and have weights at the same nodes.
  template <int dim, typename Action>
  TALUS_ALWAYS_INLINE void
  for_each_run(const Block<dim> &block, const Action &action)
  {
    for (unsigned int begin = 0, end; begin < block.size; begin = end)
      {
        end = begin + 1;
        while (end < block.size && block.nodes[end] == block.nodes[begin])
          ++end;
        action(begin, end);
      }
  }
} // namespace talus

#endif
