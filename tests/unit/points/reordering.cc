// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/reordering.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

namespace
{
  using namespace talus;

  /// Points in random segments, sorted and appended ones, of which some move
  /// and some are departed; and a reference that sorts all of them anew.
  class RandomOrder
  {
  public:
    /// @p n_cells cells, of which the points of @p share move and as many are
    /// departed; @p n_appended points more.
    RandomOrder(const unsigned int seed,
                const unsigned int n_cells,
                const double       share,
                const unsigned int n_appended)
      : random_(seed)
      , n_cells_(n_cells)
    {
      std::vector<Segment> segments;
      for (unsigned int cell = 0; cell < n_cells; ++cell)
        for (unsigned int body = 0; body < 2; ++body)
          if (const unsigned int n = below(5); n > 0)
            {
              const unsigned int begin = points.append(n);
              segments.push_back({cell, body, begin, begin + n});
              for (unsigned int p = begin; p < begin + n; ++p)
                enter(p, cell, body, share);
            }
      points.reorder({}, {}, segments);
      const unsigned int first = points.append(n_appended);
      for (unsigned int p = first; p < points.size(); ++p)
        enter(p, below(n_cells), below(2), 1.);
      for (unsigned int array = 0; array < points.n_arrays(); ++array)
        for (unsigned int p = 0; p < points.size(); ++p)
          points.data(array)[p] = value(array, p);
    }

    /// Merge and move, and compare with the reference.
    void
    check()
    {
      std::sort(expected_.begin(), expected_.end());
      Reordering reordering;
      reordering.merge(points.segments(), changes_, departed_);
      EXPECT_EQ(reordering.n_points(), expected_.size());
      reordering.apply(points);
      ASSERT_EQ(points.size(), expected_.size());
      for (unsigned int array = 0; array < points.n_arrays(); ++array)
        for (unsigned int p = 0; p < points.size(); ++p)
          ASSERT_EQ(points.data(array)[p],
                    value(array, std::get<3>(expected_[p])))
            << "array " << array << " point " << p;
      check_segments();
    }

    Points<2> points;

  private:
    unsigned int
    below(const unsigned int n)
    {
      return std::uniform_int_distribution<unsigned int>(0, n - 1)(random_);
    }

    double
    value(const unsigned int array, const unsigned int p) const
    {
      return 1000. * array + p;
    }

    /// Point p is in this cell: let it stay, move or go.
    void
    enter(const unsigned int p,
          const unsigned int cell,
          const unsigned int body,
          const double       share)
    {
      const double dice = std::uniform_real_distribution<double>()(random_);
      if (dice < share)
        {
          changes_.push_back({below(n_cells_), body, p});
          expected_.emplace_back(changes_.back().cell, body, 1, p);
        }
      else if (dice < 2. * share)
        departed_.push_back(p);
      else
        expected_.emplace_back(cell, body, 0, p);
    }

    void
    check_segments() const
    {
      std::vector<Segment> segments;
      for (unsigned int p = 0; p < expected_.size(); ++p)
        {
          const auto &[cell, body, moved, index] = expected_[p];
          if (segments.empty() || segments.back().cell != cell ||
              segments.back().body != body)
            segments.push_back({cell, body, p, p});
          segments.back().end = p + 1;
        }
      ASSERT_EQ(points.segments().size(), segments.size());
      for (unsigned int s = 0; s < segments.size(); ++s)
        {
          EXPECT_EQ(points.segments()[s].cell, segments[s].cell);
          EXPECT_EQ(points.segments()[s].body, segments[s].body);
          EXPECT_EQ(points.segments()[s].begin, segments[s].begin);
          EXPECT_EQ(points.segments()[s].end, segments[s].end);
        }
    }

    std::mt19937              random_;
    unsigned int              n_cells_;
    std::vector<CellChange>   changes_;
    std::vector<unsigned int> departed_;
    /// Cell, body, whether it moved, old index: the order to be.
    std::vector<std::tuple<unsigned int, unsigned int, int, unsigned int>>
      expected_;
  };



  /// Shares from none to all, so that runs shift down, up and not at all.
  TEST(Reordering, AsIfSortedAnew)
  {
    for (unsigned int seed = 0; seed < 20; ++seed)
      for (const double share : {0., 0.003, 0.02, 0.2, 0.5, 1.})
        for (const unsigned int n_appended : {0, 1, 10, 300})
          RandomOrder(seed, 100, share, n_appended).check();
  }



  TEST(Reordering, FewCells)
  {
    for (unsigned int seed = 0; seed < 200; ++seed)
      for (const double share : {0., 0.1, 0.4, 1.})
        for (const unsigned int n_appended : {0, 1, 4})
          RandomOrder(seed, 1 + seed % 4, share, n_appended).check();
  }



  TEST(Reordering, Nobody)
  {
    Points<2>               points;
    Reordering              reordering;
    std::vector<CellChange> changes;
    reordering.merge(points.segments(), changes, {});
    reordering.apply(points);
    EXPECT_EQ(points.size(), 0u);
    EXPECT_TRUE(points.segments().empty());
    EXPECT_EQ(reordering.n_points(), 0u);
  }



  /// One point, and those between its old and its new place.
  TEST(Reordering, OnePoint)
  {
    Points<2>            points;
    std::vector<Segment> segments;
    for (unsigned int cell = 0; cell < 10; ++cell)
      segments.push_back({cell, 0, 4 * cell, 4 * (cell + 1)});
    points.append(40);
    points.reorder({}, {}, segments);
    for (unsigned int p = 0; p < 40; ++p)
      points.data(points.id)[p] = p;

    // The last of cell 3 to cell 5: those of cells 4 and 5 go one down.
    Reordering              reordering;
    std::vector<CellChange> changes{{5, 0, 15}};
    reordering.merge(points.segments(), changes, {});
    reordering.apply(points);
    for (unsigned int p = 0; p < 40; ++p)
      EXPECT_EQ(points.data(points.id)[p],
                p < 15 || p > 23 ? p : (p < 23 ? p + 1 : 15));
  }
} // namespace
