// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_block_h
#define talus_transfer_block_h

#include <talus/base/always_inline.h>
#include <talus/grid/patch.h>
#include <talus/points/points_view.h>

#include <array>
#include <cstdint>

namespace talus
{
  template <int dim>
  struct Cell;



  /// Set of points of a block: bit k stands for point k.
  using PointsOfBlock = std::uint64_t;



  /// Up to n_points consecutive points of one body in cells of equal size, with
  /// the data the kernels need, side by side. The size of a block fits into the
  /// first-level cache, and lets loops over points fill the registers although
  /// a cell may hold only a few points.
  template <int dim>
  struct Block
  {
    static constexpr unsigned int n_points = 64; ///< bits of PointsOfBlock
    /// Length of arrays written a register at a time, beyond the last point.
    static constexpr unsigned int n_with_spare = n_points + n_spare_entries;

    /// Weights along an axis in eight rows, a column per point: values at the
    /// nodes -1, 0, 1 and 2 of the cell [-], then derivatives per cell size.
    static constexpr unsigned int begin_of_gradient = 4 * n_points;
    using Weights = std::array<double, 8 * n_points>;

    /// Points of one cell with weights at the same 3^dim nodes.
    struct SameNodesGroup
    {
      PointsOfBlock points;
      /// First of the 3^dim nodes in the patch of the cell, see Cell::patch. A
      /// row of the patch has 4 nodes.
      const unsigned int *patch;
      /// Rows of Block::weights at the first node, by axis.
      std::array<const double *, dim> weights;

      /// Return the weight of point @p k at node @p i of three along axis @p d.
      TALUS_ALWAYS_INLINE double
      value(const unsigned int d,
            const unsigned int i,
            const unsigned int k) const
      {
        return weights[d][n_points * i + k];
      }

      /// Return the derivative of value() along axis @p d, per cell size.
      TALUS_ALWAYS_INLINE double
      gradient(const unsigned int d,
               const unsigned int i,
               const unsigned int k) const
      {
        return weights[d][begin_of_gradient + n_points * i + k];
      }
    };

    /// Consecutive points of the block in one cell.
    struct CellRange
    {
      unsigned int        begin, end; ///< indices in the block
      unsigned int        cell;
      const Cell<dim>    *cell_data;
      const unsigned int *patch; ///< nodes around the cell, see Cell::patch
    };

    /// A point without a group: the box of the point reaches into a cell of
    /// another size, or the domain of the point is not a box.
    /// weights_of_point() computes the weights.
    struct IrregularPoint
    {
      unsigned int k; ///< index in the block
      unsigned int cell;
    };

    unsigned int begin = 0; ///< index of the first point in Points
    unsigned int size  = 0;
    unsigned int body  = 0;
    double       cell_size;

    unsigned int                         n_cell_ranges = 0;
    std::array<CellRange, n_points>      cell_ranges;
    unsigned int                         n_groups = 0;
    std::array<SameNodesGroup, n_points> groups;
    unsigned int                         n_irregular_points = 0;
    std::array<IrregularPoint, n_points> irregular_points;
    /// Patches of the cells that are not uniform. An invalid node is replaced
    /// by a node of the cell, since no group has a weight at an invalid node.
    unsigned int                                                  n_patches = 0;
    std::array<std::array<unsigned int, power(4, dim)>, n_points> patches;

    /// Lower corner of the cell of each point, m.
    alignas(64) std::array<std::array<double, n_with_spare>, dim> cell_lower;

    alignas(64) std::array<Weights, dim> weights;
  };



  /// Prefetch the data of all nodes near the block; address(node) is where the
  /// data of a node begin. On a large mesh the cache does not hold the nodes,
  /// and the processor cannot predict which nodes a loop over points will read:
  /// without prefetching a step on 640 000 points takes 25 % longer.
  template <int dim, typename Address>
  TALUS_ALWAYS_INLINE void
  prefetch_nodes(const Block<dim> &block, const Address &address)
  {
    constexpr unsigned int n = power(4, dim);
    for (unsigned int c = 0; c < block.n_cell_ranges; ++c)
      for (unsigned int i = 0; i < n; ++i)
        if (i % 4 == 3 || i / (n / 4) == 3 || i / 4 % 4 == 3)
          __builtin_prefetch(address(block.cell_ranges[c].patch[i]));
  }



  /// Call action(k) for each point k of the set.
  template <typename Action>
  TALUS_ALWAYS_INLINE void
  for_each_bit(const PointsOfBlock points, const Action &action)
  {
    for (PointsOfBlock left = points; left != 0; left &= left - 1)
      action(__builtin_ctzll(left));
  }
} // namespace talus

#endif
