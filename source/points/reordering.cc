#include <talus/points/reordering.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace talus
{
  namespace
  {
    /// Cell and body, compared as one number.
    template <typename Item>
    std::uint64_t
    key(const Item &item)
    {
      return std::uint64_t(item.cell) << 32 | item.body;
    }
  } // namespace



  void
  Reordering::open_segment(const unsigned int cell, const unsigned int body)
  {
    if (segments_.empty() || segments_.back().cell != cell ||
        segments_.back().body != body)
      segments_.push_back({cell, body, n_points_, n_points_});
  }



  void
  Reordering::add_mover(const Mover &mover)
  {
    open_segment(mover.cell, mover.body);
    jumps_.push_back({mover.index, n_points_});
    segments_.back().end = ++n_points_;
  }



  /// Add points that stay in the segment that is open.
  void
  Reordering::add_run(const unsigned int begin, const unsigned int end)
  {
    if (begin != n_points_)
      {
        if (!shifts_.empty() && shifts_.back().end == begin &&
            begin - shifts_.back().begin == n_points_ - shifts_.back().to)
          shifts_.back().end = end;
        else
          shifts_.push_back({begin, end, n_points_});
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



  void
  Reordering::merge(const std::vector<Segment>      &segments,
                    std::vector<Mover>              &movers,
                    const std::vector<unsigned int> &gone)
  {
    const unsigned int n_sorted = (segments.empty() ? 0 : segments.back().end);
    leaving_                    = gone;
    for (const Mover &mover : movers)
      if (mover.index < n_sorted)
        leaving_.push_back(mover.index);
    std::sort(leaving_.begin(), leaving_.end());
    std::sort(movers.begin(), movers.end(), [](const Mover &a, const Mover &b) {
      return std::make_pair(key(a), a.index) < std::make_pair(key(b), b.index);
    });

    shifts_.clear();
    jumps_.clear();
    segments_.clear();
    n_points_         = 0;
    std::size_t skip  = 0;
    auto        mover = movers.begin();
    for (const Segment &segment : segments)
      {
        for (; mover != movers.end() && key(*mover) < key(segment); ++mover)
          add_mover(*mover);
        add_staying(segment, skip);
      }
    for (; mover != movers.end(); ++mover)
      add_mover(*mover);
  }



  void
  Reordering::clear()
  {
    *this = Reordering();
  }
} // namespace talus
