// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables of quantities in time.

#include <talus/problem/time_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include <unistd.h>

using namespace talus;

namespace
{
  TimeTable
  table_of(const std::string &content)
  {
    const auto path = std::filesystem::temp_directory_path() /
                      ("talus-table-" + std::to_string(getpid()) + ".csv");
    std::ofstream(path) << content;
    const TimeTable table(path, {"a [m]", "b [-]", "c [K]"});
    std::filesystem::remove(path);
    return table;
  }
} // namespace



TEST(TimeTable, IsLinearBetweenTheRows)
{
  const TimeTable table = table_of("# of a test\n\n b [-] ,time [s],a [m]\n"
                                   "3,-1,1e1\n5,1,2e1\n# later\n5,4,-1e1\n");
  EXPECT_TRUE(table.has(0));
  EXPECT_TRUE(table.has(1));
  EXPECT_FALSE(table.has(2));
  EXPECT_EQ(table.first_time(), -1.);
  EXPECT_EQ(table.last_time(), 4.);
  const auto expect = [&](const double t, const double a, const double b) {
    EXPECT_DOUBLE_EQ(table.value(0, t), a) << t;
    EXPECT_DOUBLE_EQ(table.value(1, t), b) << t;
  };
  expect(-7., 10., 3.);
  expect(-1., 10., 3.);
  expect(-0.5, 12.5, 3.5);
  expect(1., 20., 5.);
  expect(3., 0., 5.);
  expect(4., -10., 5.);
  expect(9., -10., 5.);
}



TEST(TimeTable, ManyRows)
{
  std::ostringstream content;
  content.precision(17);
  content << "time [s],c [K]\r\n";
  for (unsigned int i = 0; i < 1000; ++i)
    content << i / 8. << ',' << 3. * i / 8. + 1. << "\r\n";
  const TimeTable table = table_of(content.str());
  for (double t = 0; t < 124.; t += 0.37)
    EXPECT_NEAR(table.value(2, t), 3. * t + 1., 1e-12 * (3. * t + 1.));
  EXPECT_EQ(table.checksum(), table_of(content.str()).checksum());
  EXPECT_NE(table.checksum(), table_of(content.str() + "200,0\n").checksum());
}
