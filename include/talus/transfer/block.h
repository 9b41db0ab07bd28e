// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_block_h
#define talus_transfer_block_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/transfer/box_shape.h>

#include <array>
#include <cstdint>

namespace talus
{
  /// Points of a block: bit k is point k.
  using PointsOfBlock = std::uint64_t;



  /// Up to n_points consecutive points of one body, in cells of one size, with
  /// what the kernels need of them side by side: small enough for the first-level
  /// cache, large enough that loops over points fill the registers although a
  /// cell may have only a few.
  template <int dim>
  struct Block
  {
    static constexpr unsigned int n_points = 64; ///< bits of PointsOfBlock
    /// What is filled a register at a time may go beyond the last point.
    static constexpr unsigned int n_with_spare =
      n_points + Points<dim>::n_spare;

    /// Weights along an axis, point by point in rows: at the nodes -1, 0, 1 and
    /// 2 of the cell, and their derivatives there, per cell size.
    static constexpr unsigned int begin_of_gradient = 4 * n_points;
    using Weights = std::array<double, 8 * n_points>;

    /// Points in one cell with weights at the same 3^dim nodes.
    struct Run
    {
      PointsOfBlock points;
      /// The first of the nodes in the patch of the cell, see Cell::patch; 4
      /// nodes of the patch are a row.
      const unsigned int *patch;
      /// The rows of the weights of that node.
      std::array<const double *, dim> weights;

      /// Weight of point @p k at node @p i of three along axis @p d.
      TALUS_ALWAYS_INLINE double
      value(const unsigned int d,
            const unsigned int i,
            const unsigned int k) const
      {
        return weights[d][n_points * i + k];
      }

      /// Its derivative along the axis, per cell size.
      TALUS_ALWAYS_INLINE double
      gradient(const unsigned int d,
               const unsigned int i,
               const unsigned int k) const
      {
        return weights[d][begin_of_gradient + n_points * i + k];
      }
    };

    /// The points of a cell.
    struct Piece
    {
      unsigned int     begin, end; ///< among those of the block
      unsigned int     cell;
      const Cell<dim> *cell_data;
    };

    /// A point that reaches into a cell of another size, or whose domain is no
    /// box: runs leave it out, and its weights are those by definition.
    struct Outsider
    {
      unsigned int k; ///< point of the block
      unsigned int cell;
    };

    unsigned int begin = 0; ///< first point
    unsigned int size  = 0;
    unsigned int body  = 0;
    double       cell_size;

    unsigned int                   n_pieces = 0;
    std::array<Piece, n_points>    pieces;
    unsigned int                   n_runs = 0;
    std::array<Run, n_points>      runs;
    unsigned int                   n_outsiders = 0;
    std::array<Outsider, n_points> outsiders;
    /// Patches of cells that are not uniform; where an entry is invalid, a node
    /// of the cell, as no run has a weight there.
    unsigned int                                                  n_patches = 0;
    std::array<std::array<unsigned int, power(4, dim)>, n_points> patches;

    /// Corner of the cell of each point, m.
    alignas(64) std::array<std::array<double, n_with_spare>, dim> cell_lower;

    alignas(64) std::array<Weights, dim> weights;
  };



  /// Walks over the points of a batch in blocks.
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
    compute_weights(Block<dim> &block) const;

    const Points<dim> &points_;
    const Grid<dim>   &grid_;
    const BoxShape    &shape_;
    unsigned int       segment_;
    unsigned int       last_segment_;
    unsigned int       n_segments_; ///< of the batch
    unsigned int       point_ = 0;  ///< the next one
  };



  /// Ask for the memory of all nodes near the block, which begins at
  /// address(node). On a large mesh it is not in the cache, and the machine,
  /// which sees ahead of loops over points, does not see which nodes will be
  /// next: without this a step on 640 000 points takes a quarter longer.
  template <int dim, typename Address>
  TALUS_ALWAYS_INLINE void
  prefetch_nodes(const Block<dim> &block, const Address &address)
  {
    constexpr unsigned int n = power(4, dim);
    for (unsigned int c = 0; c < block.n_pieces; ++c)
      for (unsigned int i = 0; i < n; ++i)
        if (i % 4 == 3 || i / (n / 4) == 3 || i / 4 % 4 == 3)
          __builtin_prefetch(address(block.pieces[c].cell_data->patch[i]));
  }



  /// Call action(k) for each of the points.
  template <typename Action>
  TALUS_ALWAYS_INLINE void
  for_each_bit(const PointsOfBlock points, const Action &action)
  {
    for (PointsOfBlock left = points; left != 0; left &= left - 1)
      action(__builtin_ctzll(left));
  }
} // namespace talus

#endif
