// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/reordering.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace talus
{
  namespace
  {
    /// Cell and body, compared as one number.
    /// See Points: the order is by cell, and within a cell by body.
    template <typename Item>
    std::uint64_t
    key(const Item &item)
    {
      return std::uint64_t(item.cell) << 32 | item.body;
    }
  } // namespace



  /// Let what is added next belong to this cell and body. Segments are opened
  /// only when a point is added, so none is ever empty.
  void
  Reordering::open_segment(const unsigned int cell, const unsigned int body)
  {
    if (segments_.empty() || segments_.back().cell != cell ||
        segments_.back().body != body)
      segments_.push_back({cell, body, n_points_, n_points_});
  }



  /// Add a point that comes from elsewhere, at the end of its segment.
  void
  Reordering::add_change(const CellChange &change)
  {
    open_segment(change.cell, change.body);
    element_moves_.push_back({change.index, n_points_});
    segments_.back().end = ++n_points_;
  }



  /// Add points that stay in the segment that is open.
  void
  Reordering::add_run(const unsigned int begin, const unsigned int end)
  {
    // Runs that are neighbours before and after are one: what Points moves is
    // copied in few long pieces.
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



  /// Add the points of an old segment except those that leave it.
  /// @param skip next entry of leaving_.
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



  /// Add the segments [@p begin, @p end) of @p segments as they are: their
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



  // Few points change their cell in a step: between the segments that are
  // entered or left, all others are copied at once.
  // Both lists are sorted, so one pass merges them as in merge sort; what would
  // make it slow is to look at every segment of a large body for a few points.
  // From where the pass is, bisection finds the next segment that a point
  // leaves, and the one behind which the next point is entered; what lies
  // between is copied as one run. A point goes behind those that stay in its
  // segment, so a segment that is only entered may be copied, too.
  //
  // Within a segment the order is part of the state, since sums depend on it:
  // the points that stay keep theirs, and the others follow by their index. So
  // runs are the same bit by bit, however the changes were found.
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
        // The first segment behind the one that is entered next, and the first
        // that is left.
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
        // Segments that did not exist, and those behind the one copied last.
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
