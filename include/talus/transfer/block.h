#ifndef talus_transfer_block_h
#define talus_transfer_block_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/loads.h>
#include <talus/transfer/weights.h>

namespace talus
{
  /// Part of a segment in a block.
  struct Piece
  {
    unsigned int cell;
    unsigned int begin; ///< within the block
    unsigned int end;
  };

  /// Up to n_points consecutive points whose cells are uniform, with what the
  /// kernels need of them side by side: small enough for the first-level cache,
  /// large enough that loops over points fill the registers although a cell may
  /// have only a few.
  template <int dim>
  struct Block
  {
    static constexpr unsigned int n_points = 64;
    using Row                              = std::array<double, n_points>;

    unsigned int                begin    = 0; ///< first point
    unsigned int                size     = 0;
    unsigned int                n_pieces = 0;
    std::array<Piece, n_points> pieces;

    alignas(64) std::array<Row, dim> cell_lower;
    alignas(64) Row inverse_cell_size;
    alignas(64) std::array<Row, dim> body_acceleration;

    alignas(64) std::array<std::array<Row, 4>, dim> value;
    alignas(64) std::array<std::array<Row, 4>, dim> gradient; ///< 1/m
  };



  /// Walks over the points in blocks; points in cells that are not uniform are
  /// passed over.
  template <int dim>
  class BlockWalk
  {
  public:
    BlockWalk(Points<dim>      &points,
              const Grid<dim>  &grid,
              const Loads<dim> &loads,
              const BoxShape   &shape)
      : points_(points)
      , grid_(grid)
      , loads_(loads)
      , shape_(shape)
    {}

    /// Fill @p block with the next points; false if there are none left.
    bool
    next(Block<dim> &block);

  private:
    void
    take_piece(Block<dim> &block, const Segment &segment, unsigned int n);
    void
    compute_weights(Block<dim> &block) const;

    Points<dim>      &points_;
    const Grid<dim>  &grid_;
    const Loads<dim> &loads_;
    const BoxShape   &shape_;
    unsigned int      segment_ = 0;
    unsigned int      taken_   = 0; ///< points of the segment
  };
} // namespace talus

#endif
