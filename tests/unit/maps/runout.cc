// SPDX-License-Identifier: LGPL-2.1-or-later
// Rows of runout.csv for soil that is moved by hand.

#include <talus/maps/runout.h>

#include "observers_setup.h"

namespace runout_rows_test
{
  using namespace talus;
  using dealii::Point;

  /// A table of numbers, NaN for an empty field, and of the fields as written.
  struct RunoutTest : ObserversTest
  {
    using Row = std::vector<std::string>;

    Row
    last_row() const
    {
      Row                row;
      std::istringstream in(lines("runout.csv").back() + ",");
      for (std::string field; std::getline(in, field, ',');)
        row.push_back(field);
      return row;
    }

    /// Expect time, runout, front, rear, centre, speed, fastest column, length.
    void
    expect_row(const std::vector<double> &expected) const
    {
      const Row row = last_row();
      ASSERT_EQ(row.size(), expected.size());
      for (unsigned int i = 0; i < row.size(); ++i)
        EXPECT_NEAR(std::stod(row[i]), expected[i], 1e-12) << i;
    }

    const Point<3> origin;
  };



  /// Two boxes of half a metre, 0.25 m thick in the mean, at x = 1.5 and 2.5 m.
  struct TwoBoxes : Scene<2>
  {
    TwoBoxes()
      : Scene<2>("0, 0", "12, 4")
    {
      for (const double x : {1.5, 2.5})
        add({x, 0.5}, 1., {2., -1.});
      sort();
    }

    void
    move(const double distance)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        points.data(points.position)[p] += distance;
      sort();
      time += 1.;
      ++step;
    }
  };
} // namespace runout_rows_test



using runout_rows_test::RunoutTest;

TEST_F(RunoutTest, OfSoilThatMovesAndComesBack)
{
  using namespace runout_rows_test;
  Runout<2> runout(origin);
  TwoBoxes  soil;
  runout.begin({folder}, soil, Beginning::fresh);
  runout.start(soil);
  runout.observe(soil);
  // Without a way there are no places along it.
  expect_row({0., 0., 0., 0., 0., 2., 0., 0.});
  soil.move(3.);
  runout.observe(soil);
  expect_row({1., 3., 4., 2., 3., 2., 2., 2.});
  // Six metres beyond the start of the way.
  soil.move(3.);
  runout.observe(soil);
  expect_row({2., 6., 7., 5., 6., 2., 2., 2.});
  soil.move(-1.);
  runout.observe(soil);
  expect_row({3., 5., 6., 4., 5., 2., 2., 2.});
}



// To the left, distances along the way count to the left.
TEST_F(RunoutTest, ToTheLeft)
{
  using namespace runout_rows_test;
  Runout<2> runout(origin);
  TwoBoxes  soil;
  soil.move(8.);
  runout.begin({folder}, soil, Beginning::fresh);
  runout.start(soil);
  soil.move(-5.);
  runout.observe(soil);
  expect_row({2., 5., 6., 4., 5., 2., 2., 2.});
}



// Soil that is thinner than a tenth of a cell everywhere has no front: fields
// without a value are empty, as spreadsheets and the report expect.
TEST_F(RunoutTest, WithoutThickSoilFieldsAreEmpty)
{
  using namespace runout_rows_test;
  Runout<2> runout(origin);
  TwoBoxes  soil;
  runout.begin({folder}, soil, Beginning::fresh);
  runout.start(soil);
  soil.move(3.);
  for (unsigned int p = 0; p < soil.points.size(); ++p)
    soil.points.data(soil.points.edges, 3)[p] = 0.1; // y of edge 1: 0.05 m^2
  runout.observe(soil);
  const Row row = last_row();
  EXPECT_EQ(row, (Row{"1", "", "", "", "3", "2", "0", "0"}));
}



// Ends of boxes within the outermost columns, a metre wide, whose soil is thick
// enough; along x and z. The single thin point beyond is not seen.
TEST_F(RunoutTest, EndsOfThickSoil)
{
  using namespace runout_rows_test;
  Runout<3> runout(origin);
  Scene<3>  soil("0, 0, 0", "12, 4, 12");
  for (const double x : {4.4, 5.4})
    soil.add({x, 0.5, 7.3});
  soil.add({9.5, 0.5, 2.5});
  soil.points.data(soil.points.edges, 4)[2] = 1e-3; // y of edge 1
  soil.sort();
  Quantities ends;
  runout.list_thick_soil(soil, ends);
  ASSERT_EQ(ends.size(), 4u);
  const std::vector<double> expected = {5.65, 4.15, 7.55, 7.05};
  for (unsigned int i = 0; i < 4; ++i)
    EXPECT_NEAR(ends[i].value, expected[i], 1e-12) << ends[i].heading();
  EXPECT_EQ(ends[2].heading(), "front of thick soil z [m]");
  EXPECT_EQ(ends[3].heading(), "rear of thick soil z [m]");
}
