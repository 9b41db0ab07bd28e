// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/envelope.h>
#include <talus/maps/plan_columns.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace talus;
using dealii::Point;

namespace
{
  /// Boxes anywhere in [0, 8], and around it by @p beyond.
  template <int dim>
  Footprints<dim>
  random_footprints(const unsigned int n, const double beyond = 1.)
  {
    std::mt19937                           engine(4711);
    std::uniform_real_distribution<double> centre(-beyond, 8. + beyond),
      half(0., 2.5);
    Footprints<dim> footprints;
    footprints.resize(n);
    for (unsigned int a = 0; a < dim - 1; ++a)
      for (unsigned int i = 0; i < n; ++i)
        {
          footprints.centre[a][i] = centre(engine);
          footprints.half[a][i]   = half(engine);
        }
    return footprints;
  }

  template <int dim>
  Footprints<dim>
  one_footprint(const std::array<double, dim - 1> &centre,
                const std::array<double, dim - 1> &half)
  {
    Footprints<dim> footprints;
    footprints.resize(1);
    for (unsigned int a = 0; a < dim - 1; ++a)
      {
        footprints.centre[a][0] = centre[a];
        footprints.half[a][0]   = half[a];
      }
    return footprints;
  }

  /// Shares by item and column.
  template <int dim>
  std::map<std::pair<unsigned int, unsigned int>, double>
  shares_of(const PlanColumns<dim> &columns, const Footprints<dim> &footprints)
  {
    ColumnShares shares;
    columns.find_shares(footprints, shares);
    std::map<std::pair<unsigned int, unsigned int>, double> result;
    for (const ColumnShare &share : shares)
      result[{share.item, share.column}] += share.share;
    return result;
  }

  template <int dim>
  LatticeColumns<dim>
  lattice_of_eight()
  {
    std::array<typename LatticeColumns<dim>::Axis, dim - 1> axes;
    axes.fill({0., 0.5, 16});
    return LatticeColumns<dim>(axes);
  }

  /// From 10 to 18.
  LatticeColumns<2>
  four_columns()
  {
    std::array<LatticeColumns<2>::Axis, 1> axes;
    axes[0] = {10., 2., 4};
    return LatticeColumns<2>(axes);
  }
} // namespace



TEST(PlanColumns, SharesOfABox)
{
  const LatticeColumns<2> columns = four_columns();
  EXPECT_EQ(columns.size(), 4u);
  EXPECT_EQ(columns.area(), 2.);
  EXPECT_EQ(columns.centre(3)[0], 17.);
  // From 11.5 to 16.5: 0.5, 2, 2 and 0.5 of 5 m.
  const auto shares = shares_of<2>(columns, one_footprint<2>({{14.}}, {{2.5}}));
  ASSERT_EQ(shares.size(), 4u);
  EXPECT_NEAR(shares.at({0, 0}), 0.1, 1e-15);
  EXPECT_NEAR(shares.at({0, 1}), 0.4, 1e-15);
  EXPECT_NEAR(shares.at({0, 2}), 0.4, 1e-15);
  EXPECT_NEAR(shares.at({0, 3}), 0.1, 1e-15);
}



TEST(PlanColumns, WhatLiesOutsideCountsToTheOutermost)
{
  const LatticeColumns<2> columns = four_columns();
  for (const auto &[centre, half, column] : {std::tuple(9., 1.5, 0u),
                                             {18., 1., 3u},
                                             {1e300, 1., 3u},
                                             {-1e300, 1., 0u}})
    {
      const auto shares =
        shares_of<2>(columns, one_footprint<2>({{centre}}, {{half}}));
      ASSERT_EQ(shares.size(), 1u);
      EXPECT_NEAR(shares.at({0, column}), 1., 1e-15);
    }
}



// To the column that begins at the face.
TEST(PlanColumns, BoxWithoutWidth)
{
  const LatticeColumns<2> columns = four_columns();
  const auto shares = shares_of<2>(columns, one_footprint<2>({{14.}}, {{0.}}));
  ASSERT_EQ(shares.size(), 1u);
  EXPECT_EQ(shares.at({0, 2}), 1.);
}



// A quarter along x of the second column, all along z of the third row.
TEST(PlanColumns, RowsRunAlongX)
{
  std::array<LatticeColumns<3>::Axis, 2> axes;
  axes[0] = {0., 1., 5};
  axes[1] = {0., 1., 4};
  const LatticeColumns<3> columns(axes);
  const auto              shares =
    shares_of<3>(columns, one_footprint<3>({{2., 2.5}}, {{0.5, 0.25}}));
  ASSERT_EQ(shares.size(), 2u);
  EXPECT_NEAR(shares.at({0, 2 * 5 + 1}), 0.5, 1e-15);
  EXPECT_NEAR(shares.at({0, 2 * 5 + 2}), 0.5, 1e-15);
  EXPECT_EQ(columns.centre(11), Point<3>(1.5, 0., 2.5));
}



template <int dim>
void
check_that_nothing_is_lost()
{
  const auto          footprints = random_footprints<dim>(300);
  std::vector<double> sums(footprints.size());
  for (const auto &[key, share] :
       shares_of<dim>(lattice_of_eight<dim>(), footprints))
    sums[key.first] += share;
  for (const double sum : sums)
    EXPECT_NEAR(sum, 1., 1e-14);
}

TEST(PlanColumns, NothingIsLost)
{
  check_that_nothing_is_lost<2>();
  check_that_nothing_is_lost<3>();
}



// Squares side by side are the lattice.
template <int dim>
void
compare_squares_with_lattice()
{
  const auto              columns = lattice_of_eight<dim>();
  std::vector<Point<dim>> centres;
  for (unsigned int c = columns.size(); c-- > 0;)
    centres.push_back(columns.centre(c));
  const SquareColumns<dim> squares(centres, 0.5);
  EXPECT_EQ(squares.area(), columns.area());
  // All of them inside.
  const auto footprints = random_footprints<dim>(300, -2.5);
  const auto expected   = shares_of<dim>(columns, footprints);
  const auto found      = shares_of<dim>(squares, footprints);
  for (const auto &[key, share] : expected)
    if (share > 1e-12)
      {
        EXPECT_NEAR(found.at({key.first, columns.size() - 1 - key.second}),
                    share,
                    1e-14);
      }
  EXPECT_GT(expected.size(), 1000u);
}

TEST(PlanColumns, SquaresAsLattice)
{
  compare_squares_with_lattice<2>();
  compare_squares_with_lattice<3>();
}



TEST(PlanColumns, SquaresKnowWhatMayReachThem)
{
  const SquareColumns<2> squares({Point<2>(5., 7.), Point<2>(1., 0.)}, 1.);
  const auto may_reach = [&](const double lower, const double upper) {
    return squares.may_reach({Point<2>(lower, 0.), Point<2>(upper, 1.)});
  };
  EXPECT_TRUE(may_reach(0., 0.6));
  EXPECT_FALSE(may_reach(1.6, 4.4));
  EXPECT_TRUE(may_reach(0., 9.));
  EXPECT_FALSE(may_reach(5.6, 9.));
}



// The first of equal values counts.
TEST(Envelope, PeakRemembersWhen)
{
  Peak peak;
  EXPECT_TRUE(std::isnan(peak.time));
  peak.add(0., 0.);
  EXPECT_EQ(peak.time, 0.);
  peak.add(2., 1.);
  peak.add(2., 2.);
  peak.add(1., 3.);
  EXPECT_EQ(peak.value, 2.);
  EXPECT_EQ(peak.time, 1.);
}



// Rows of a checkpoint: two columns, one threshold not reached.
TEST(Envelope, SavedAndRestored)
{
  const Envelope<2>::Settings settings{0.1, {1., 2.}, {}};
  constexpr unsigned int      n   = Envelope<2>::n_numbers(2);
  const double                nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<double>         rows;
  for (const double column : {3., 7.})
    {
      rows.push_back(column);
      for (unsigned int i = 1; i + 1 < n; ++i)
        rows.push_back(column + 0.1 * i);
      rows.push_back(nan);
    }
  Envelope<2> envelope(10, settings);
  envelope.restore(rows);
  EXPECT_EQ(envelope.reached(), (std::vector<unsigned int>{3, 7}));
  EXPECT_EQ(envelope[7].thickness, rows[n + 1]);
  EXPECT_EQ(envelope[7].impact_pressure.time, rows[n + 13]);
  EXPECT_EQ(envelope[7].arrival[0], rows[n + 14]);
  const std::vector<double> again = envelope.save();
  ASSERT_EQ(again.size(), rows.size());
  for (unsigned int i = 0; i < rows.size(); ++i)
    EXPECT_TRUE(again[i] == rows[i] ||
                (std::isnan(again[i]) && std::isnan(rows[i])));

  Envelope<2> smaller(5, settings);
  EXPECT_THROW(smaller.restore(rows), ExcUser);
}



TEST(Envelope, FieldsOfColumnsThatWereNeverReached)
{
  const ColumnHistory history;
  for (const HistoryField &field : history_fields({0.5}))
    EXPECT_TRUE(field.value(history) == 0 || std::isnan(field.value(history)));
}
