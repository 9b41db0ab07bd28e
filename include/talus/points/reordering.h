// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_reordering_h
#define talus_points_reordering_h

#include <talus/points/points.h>

#include <cstddef>
#include <vector>

namespace talus
{
  /// A point that moves to another segment: new cell, body, index of the point.
  struct CellChange
  {
    unsigned int cell;
    unsigned int body;
    unsigned int index;
  };



  /// Computes the new order of the points when some change their segment, leave
  /// or are appended. Works on the lists of segments and changes only;
  /// Points::reorder() moves the data.
  class Reordering
  {
  public:
    /// Compute the new order of the points. Within a segment points that stay
    /// come first, then changed points by index.
    ///
    /// @param segments old segments
    /// @param changes points with their new segments; sorted by this function
    /// @param departed points that leave this rank or the run
    void
    merge(const std::vector<Segment>      &segments,
          std::vector<CellChange>         &changes,
          const std::vector<unsigned int> &departed);

    /// Apply the new order to @p points.
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

    /// Clear all lists and free their memory.
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
