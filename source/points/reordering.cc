// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/reordering.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace talus
{
  namespace
  {
    /// Cell and body as one number, for comparison in the order of Points: by
    /// cell, then by body.
    template <typename Item>
    std::uint64_t
    key(const Item &item)
    {
      return std::uint64_t(item.cell) << 32 | item.body;
    }
  } // namespace



  /// Set the segment of the points added next. A segment is created just before
  /// a point is added, so no segment is empty.
  void
  Reordering::open_segment(const unsigned int cell, const unsigned int body)
  {
    if (segments_.empty() || segments_.back().cell != cell ||
        segments_.back().body != body)
      segments_.push_back({cell, body, n_points_, n_points_});
  }



  /// Append a changed or new point to its segment.
  void
  Reordering::add_change(const CellChange &change)
  {
    open_segment(change.cell, change.body);
    element_moves_.push_back({change.index, n_points_});
    segments_.back().end = ++n_points_;
  }



  /// Append points that stay in the current segment.
  void
  Reordering::add_run(const unsigned int begin, const unsigned int end)
  {
    // Merge ranges that are adjacent before and after the move, so that data
    // are copied in few long pieces.
    if (begin != n_points_)
      {
        if (!block_moves_.empty() && block_moves_.back().end == begin &&
            begin - block_moves_.back().begin ==
              n_points_ - block_moves_.back().to)
          block_moves_.back().end = end;
        else
          block_moves_.push_back({begin, end, n_points_});
      }
    n_points_ += end - begin;
    segments_.back().end = n_points_;
  }



  /// Append the points of an old segment that do not leave the segment.
  ///
  /// @param segment old segment
  /// @param skip index of the next entry of leaving_; advanced beyond the
  ///   segment
  void
  Reordering::add_staying(const Segment &segment, std::size_t &skip)
  {
    unsigned int begin = segment.begin;
    for (; skip < leaving_.size() && leaving_[skip] < segment.end; ++skip)
      {
        if (begin < leaving_[skip])
          {
            open_segment(segment.cell, segment.body);
            add_run(begin, leaving_[skip]);
          }
        begin = leaving_[skip] + 1;
      }
    if (begin < segment.end)
      {
        open_segment(segment.cell, segment.body);
        add_run(begin, segment.end);
      }
  }



  /// Append the segments [begin, end) of @p segments without change: their
  /// points move together.
  void
  Reordering::add_unchanged(const std::vector<Segment> &segments,
                            const std::size_t           begin,
                            const std::size_t           end)
  {
    if (begin == end)
      return;
    const unsigned int shift    = n_points_ - segments[begin].begin; // mod 2^32
    const std::size_t  old_size = segments_.size();
    segments_.insert(segments_.end(),
                     segments.begin() + begin,
                     segments.begin() + end);
    for (std::size_t s = old_size; s < segments_.size(); ++s)
      {
        segments_[s].begin += shift;
        segments_[s].end += shift;
      }
    add_run(segments[begin].begin, segments[end - 1].end);
  }



  // Few points change their cell in a step: all segments between two changed
  // segments are copied at once. Both lists are sorted, so a single pass merges
  // them as in merge sort. Visiting every segment of a large body for a few
  // points would be slow. Bisection finds the next segment that a point leaves,
  // and the segment behind which the next point is inserted; everything before
  // is copied as one range. A new point comes behind the points that stay, so a
  // segment that only gains points may be copied, too.
  //
  // The order within a segment is part of the state, since sums depend on it:
  // points that stay keep their order, and changed points follow by index.
  // Results are therefore bit-identical, however the changes were found.
  void
  Reordering::merge(const std::vector<Segment>      &segments,
                    std::vector<CellChange>         &changes,
                    const std::vector<unsigned int> &departed)
  {
    const unsigned int n_sorted = (segments.empty() ? 0 : segments.back().end);
    leaving_                    = departed;
    for (const CellChange &change : changes)
      // Appended points leave no segment.
      if (change.index < n_sorted)
        leaving_.push_back(change.index);
    std::sort(leaving_.begin(), leaving_.end());
    std::sort(changes.begin(),
              changes.end(),
              [](const CellChange &a, const CellChange &b) {
                return std::make_pair(key(a), a.index) <
                       std::make_pair(key(b), b.index);
              });

    block_moves_.clear();
    element_moves_.clear();
    segments_.clear();
    n_points_          = 0;
    std::size_t skip   = 0;
    auto        change = changes.begin();
    for (std::size_t s = 0; s < segments.size(); ++s)
      {
        // First segment behind the segment of the next change, and first
        // segment that a point leaves.
        const auto entered = std::partition_point(
          segments.begin() + s, segments.end(), [&](const Segment &segment) {
            return change == changes.end() || key(segment) <= key(*change);
          });
        const auto left = std::partition_point(
          segments.begin() + s, segments.end(), [&](const Segment &segment) {
            return skip == leaving_.size() || segment.end <= leaving_[skip];
          });
        const std::size_t next = std::min(entered, left) - segments.begin();
        add_unchanged(segments, s, next);
        s = next;
        if (s == segments.size())
          break;
        // Changes into new segments, and into the segment copied last.
        for (; change != changes.end() && key(*change) < key(segments[s]);
             ++change)
          add_change(*change);
        add_staying(segments[s], skip);
      }
    for (; change != changes.end(); ++change)
      add_change(*change);
  }



  void
  Reordering::clear()
  {
    *this = Reordering();
  }
} // namespace talus
