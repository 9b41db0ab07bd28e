// SPDX-License-Identifier: LGPL-2.1-or-later
// Memory on large pages, and the rows of numbers that lie there.

#include <talus/base/large_pages.h>
#include <talus/points/points.h>
#include <talus/points/rows.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace
{
  using namespace talus;

  std::uintptr_t
  address(const void *memory)
  {
    return reinterpret_cast<std::uintptr_t>(memory);
  }



  /// Entry i of row r is 1000 r + i in [0, length).
  void
  number(Rows &rows, const unsigned int length)
  {
    for (unsigned int r = 0; r < rows.size(); ++r)
      for (unsigned int i = 0; i < length; ++i)
        rows[r][i] = 1000. * r + i;
  }



  void
  expect_numbered(const Rows        &rows,
                  const unsigned int n_rows,
                  const unsigned int length)
  {
    for (unsigned int r = 0; r < n_rows; ++r)
      for (unsigned int i = 0; i < length; ++i)
        ASSERT_EQ(rows[r][i], 1000. * r + i) << "row " << r << ", entry " << i;
  }
} // namespace



TEST(LargePages, BeginAtAPageAndAreZero)
{
  for (const std::size_t bytes : {1u, 1u << 21, (1u << 21) + 1})
    {
      auto *const memory = static_cast<char *>(map_large_pages(bytes));
      EXPECT_EQ(address(memory) % (1 << 21), 0u) << bytes << " bytes";
      EXPECT_EQ(memory[0], 0);
      EXPECT_EQ(memory[bytes - 1], 0);
      memory[bytes - 1] = 1;
      unmap_large_pages(memory, bytes);
    }
  EXPECT_THROW(map_large_pages(std::numeric_limits<std::size_t>::max() / 2),
               std::bad_alloc);
}



// Only whole pages within the range are given back.
TEST(LargePages, EmptyKeepsWhatSharesAPage)
{
  constexpr std::size_t page   = 1 << 21;
  auto *const           memory = static_cast<char *>(map_large_pages(3 * page));
  const std::size_t     probes[] = {99, page - 1, 2 * page, 3 * page - 1};
  for (const std::size_t i : probes)
    memory[i] = 1;
  memory[page + 5] = 1;
  empty_large_pages(memory + 100, memory + 2 * page + 1);
#ifdef __linux__
  EXPECT_EQ(memory[page + 5], 0);
#endif
  empty_large_pages(memory + 2 * page + 100, memory + 2 * page + 200);
  for (const std::size_t i : probes)
    EXPECT_EQ(memory[i], 1) << i;
  unmap_large_pages(memory, 3 * page);
}



TEST(LargePages, VectorKeepsWhatItHoldsWhileItGrows)
{
  LargePageVector<double> values;
  for (unsigned int i = 0; i < 300000; ++i) // from the heap to large pages
    values.push_back(i);
  EXPECT_EQ(address(values.data()) % (1 << 21), 0u);
  for (unsigned int i = 0; i < values.size(); ++i)
    ASSERT_EQ(values[i], i);
  EXPECT_EQ(LargePageVector<double>(values), values);
}



TEST(Rows, KeepWhatTheyHold)
{
  Rows rows;
  rows.reshape(3, 400);
  for (unsigned int r = 0; r < 3; ++r)
    for (unsigned int i = 0; i < 400; ++i)
      ASSERT_EQ(rows[r][i], 0.);
  number(rows, 400);

  rows.reshape(5, 900000); // over several large pages
  expect_numbered(rows, 3, 400);
  EXPECT_EQ(rows[2][400], 0.);
  EXPECT_EQ(rows[4][0], 0.);
  EXPECT_EQ(rows[4][899999], 0.);
  number(rows, 900000);

  rows.reshape(6, 1000000);
  expect_numbered(rows, 5, 900000);
  EXPECT_EQ(rows[4][900000], 0.);

  const Rows copy(rows);
  expect_numbered(copy, 5, 900000);
  rows[0][0] = -1.;
  EXPECT_EQ(copy[0][0], 0.);
  rows[0][0] = 0.;

  rows.reshape(2, 100);
  EXPECT_EQ(rows.size(), 2u);
  expect_numbered(rows, 2, 100);
}



// Loads of whole registers, and lines of the cache that begin at a multiple of
// eight points, count on it; rows that all begin at the same place of a page of
// 4 kB would push each other out of the caches.
TEST(Rows, BeginAtLinesAndApart)
{
  for (const unsigned int length : {1u, 512u, 1024u, 4096u, 65536u, 100001u})
    {
      Rows rows;
      rows.reshape(27, length);
      std::vector<unsigned int> rows_at(64, 0);
      for (unsigned int r = 0; r < rows.size(); ++r)
        {
          EXPECT_EQ(address(rows[r]) % 64, 0u);
          ++rows_at[address(rows[r]) / 64 % 64];
          if (r > 0)
            {
              EXPECT_GE(rows[r], rows[r - 1] + length);
            }
        }
      EXPECT_EQ(*std::max_element(rows_at.begin(), rows_at.end()), 1u)
        << "length " << length;
    }
}



// Points that are appended one by one make the arrays grow many times.
TEST(Rows, PointsGrow)
{
  Points<2> points;
  for (unsigned int p = 0; p < 5000; ++p)
    {
      ASSERT_EQ(points.append(1), p);
      for (unsigned int a = 0; a < points.n_arrays(); ++a)
        points.data(a)[p] = 10000. * a + p;
    }
  const unsigned int added =
    points.add_column("test", "-", 1, Inheritance::copied);
  EXPECT_EQ(added, points.n_arrays() - 1);
  for (unsigned int p = 0; p < 5000; ++p)
    {
      for (unsigned int a = 0; a < added; ++a)
        ASSERT_EQ(points.data(a)[p], 10000. * a + p);
      ASSERT_EQ(points.data(added)[p], 0.);
    }
}



TEST(Rows, ReadersKeepTheirMemory)
{
  Rows rows;
  rows.reshape(3, 1000);
  number(rows, 1000);
  const std::shared_ptr<const double> memory = rows.memory();
  const std::size_t                   pitch  = rows.pitch();
  rows.reshape(3, 100000);
  expect_numbered(rows, 3, 1000);
  EXPECT_NE(memory.get(), rows[0]);
  rows = Rows();
  for (unsigned int r = 0; r < 3; ++r)
    for (unsigned int i = 0; i < 1000; ++i)
      ASSERT_EQ(memory.get()[r * pitch + i], 1000. * r + i);
}
