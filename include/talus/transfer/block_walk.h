// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_block_walk_h
#define talus_transfer_block_walk_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/transfer/block.h>
#include <talus/transfer/box_shape.h>
#include <talus/transfer/group_memory.h>

namespace talus
{
  /// Splits the points of a batch into blocks. Optionally the groups of the
  /// blocks are stored, or those of a previous walk restored.
  template <int dim>
  class BlockWalk
  {
  public:
    BlockWalk(const Points<dim> &points,
              const Batch       &batch,
              const Grid<dim>   &grid,
              const BoxShape    &shape,
              GroupMemory<dim>  *store,
              GroupMemory<dim>  *restore)
      : points_(points)
      , grid_(grid)
      , shape_(shape)
      , segment_(batch.first_segment)
      , last_segment_(batch.last_segment)
      , n_segments_(batch.last_segment - batch.first_segment)
      , store_(store)
      , restore_(restore)
    {}

    /// Fill @p block with the next points. Return false if no point is left.
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
    unsigned int       n_segments_;       ///< number of segments in the batch
    unsigned int       point_ = 0;        ///< next point
    GroupMemory<dim>  *store_, *restore_; ///< or null
  };
} // namespace talus

#endif
