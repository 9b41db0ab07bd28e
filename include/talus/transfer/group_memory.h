// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_group_memory_h
#define talus_transfer_group_memory_h

#include <talus/transfer/block.h>

#include <vector>

namespace talus
{
  /// Groups of all blocks, in the order of the blocks. The first sweep of a
  /// step stores the groups, and the second sweep, over the same points, boxes
  /// and cells, restores them: the search for groups has branches that the
  /// processor cannot predict.
  template <int dim>
  class GroupMemory
  {
  public:
    /// Forget all groups.
    void
    clear()
    {
      groups_.clear();
      n_groups_.clear();
    }

    /// Let restore() begin with the first block.
    void
    rewind()
    {
      next_group_ = next_block_ = 0;
    }

    void
    store(const Block<dim> &block);

    /// Set the groups of the next block. Returns false if they must be searched
    /// again: blocks with irregular points or own patches are not stored.
    bool
    restore(Block<dim> &block);

  private:
    static constexpr unsigned int not_stored = -1;

    /// Block::SameNodesGroup without addresses in the block.
    struct Group
    {
      PointsOfBlock       points;
      const unsigned int *patch;
      unsigned int        above; ///< as in Block, bit d for axis d
    };

    std::vector<Group>        groups_;
    std::vector<unsigned int> n_groups_; ///< by block
    std::size_t               next_group_ = 0, next_block_ = 0;
  };



  template <int dim>
  inline void
  GroupMemory<dim>::store(const Block<dim> &block)
  {
    if (block.n_irregular_points > 0 || block.n_patches > 0)
      {
        n_groups_.push_back(not_stored);
        return;
      }
    n_groups_.push_back(block.n_groups);
    for (unsigned int r = 0; r < block.n_groups; ++r)
      {
        const auto  &group = block.groups[r];
        unsigned int above = 0;
        for (unsigned int d = 0; d < dim; ++d)
          above |= (group.weights[d] != block.weights[d].data()) << d;
        groups_.push_back({group.points, group.patch, above});
      }
  }



  template <int dim>
  inline bool
  GroupMemory<dim>::restore(Block<dim> &block)
  {
    block.n_groups = block.n_irregular_points = block.n_patches = 0;
    const unsigned int n = n_groups_[next_block_++];
    if (n == not_stored)
      return false;
    block.n_groups    = n;
    const Group *from = groups_.data() + next_group_;
    next_group_ += n;
    for (unsigned int r = 0; r < n; ++r)
      {
        auto &group  = block.groups[r];
        group.points = from[r].points;
        group.patch  = from[r].patch;
        for (unsigned int d = 0; d < dim; ++d)
          group.weights[d] =
            &block
               .weights[d][((from[r].above >> d) & 1) * Block<dim>::n_points];
      }
    return true;
  }
} // namespace talus

#endif
