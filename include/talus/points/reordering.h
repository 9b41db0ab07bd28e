// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_reordering_h
#define talus_points_reordering_h

#include <talus/points/points.h>

#include <cstddef>
#include <vector>

namespace talus
{
  /// A point that changes its segment: its new cell, its body and its index.
  struct CellChange
  {
    unsigned int cell;
    unsigned int body;
    unsigned int index;
  };



  /// Works out how points that change their segment, and those appended, come
  /// into the order of those that stay. For Points::reorder(), which moves the
  /// data; here nothing but the lists of segments and changes is looked at.
  class Reordering
  {
  public:
    /// The points of @p segments but for the @p changes, which become sorted,
    /// and for those @p departed elsewhere, merged with the changes. Within a
    /// segment those that stay come first, then the changes, by their index.
    void
    merge(const std::vector<Segment>      &segments,
          std::vector<CellChange>         &changes,
          const std::vector<unsigned int> &departed);

    /// Let Points::reorder() move the points.
    template <int dim>
    void
    apply(Points<dim> &points)
    {
      points.reorder(block_moves_, element_moves_, segments_);
    }

    /// Number of points in the new order.
    unsigned int
    n_points() const
    {
      return n_points_;
    }

    /// Forget all, memory included.
    void
    clear();

  private:
    void
    open_segment(unsigned int cell, unsigned int body);
    void
    add_change(const CellChange &change);
    void
    add_run(unsigned int begin, unsigned int end);
    void
    add_unchanged(const std::vector<Segment> &segments,
                  std::size_t                 begin,
                  std::size_t                 end);
    void
    add_staying(const Segment &segment, std::size_t &skip);

    // Kept between calls so that a step does not allocate.
    std::vector<unsigned int> leaving_; ///< points that leave their segment
    std::vector<BlockMove>    block_moves_;
    std::vector<ElementMove>  element_moves_;
    std::vector<Segment>      segments_;
    unsigned int              n_points_ = 0;
  };
} // namespace talus

#endif
