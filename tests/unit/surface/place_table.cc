// SPDX-License-Identifier: LGPL-2.1-or-later
// Rows of numbers by place of a surface, on any rank.

#include <talus/surface/place_table.h>

#include "ranks_setup.h"
#include "suites.h"

namespace place_table_test
{
  TALUS_ALSO_ON_RANKS(PlaceTable, 2, 3);

  constexpr unsigned int n_places  = 12;
  const MPI_Comm         all_ranks = MPI_COMM_WORLD;

  enum class Kind
  {
    none,
    odd,
    even
  };

  struct Row
  {
    double       number = 0;
    Kind         kind   = Kind::none;
    Tensor<1, 2> vector;
    double       geometry = 7.; // not saved

    static constexpr unsigned int n_keys  = 3;
    static constexpr const char  *columns = "place; number; kind; vector";

    bool
    is_kept() const
    {
      return number > 0;
    }

    auto
    values()
    {
      return std::tie(number, kind, vector);
    }
  };



  PlaceKey
  place(const unsigned int i)
  {
    return place_key((5ul << 32) + i, 2);
  }



  /// Places of this rank in partition @p shift, without every third of all
  /// places if @p is_partial.
  std::vector<PlaceKey>
  places(const unsigned int shift, const bool is_partial = false)
  {
    std::vector<PlaceKey> result;
    for (unsigned int i = 0; i < n_places; ++i)
      if ((i + shift) % MPI::n_mpi_processes(all_ranks) ==
            MPI::this_mpi_process(all_ranks) &&
          !(is_partial && i % 3 == 0))
        result.push_back(place(i));
    return result;
  }



  /// Table with a row for each place, of which the first is not kept.
  PlaceTable<Row>
  filled(const bool outlives_places)
  {
    PlaceTable<Row> table(outlives_places);
    table.move_to(places(0), all_ranks);
    for (unsigned int k = 0; k < table.size(); ++k)
      {
        const unsigned int i = table.places()[k][1];
        table[k]             = {double(i),
                    i % 2 == 0 ? Kind::even : Kind::odd,
                                Tensor<1, 2>({-1. * i, 3.}),
                                8.};
      }
    return table;
  }



  /// Expect the row of place @p i, or a default row.
  void
  expect(const Row &row, const unsigned int i, const bool has_row = true)
  {
    const bool is_known = has_row && i > 0;
    EXPECT_EQ(row.number, is_known ? i : 0.);
    EXPECT_EQ(row.kind,
              !is_known    ? Kind::none
              : i % 2 == 0 ? Kind::even
                           : Kind::odd);
    EXPECT_EQ(row.vector[0], is_known ? -1. * i : 0.);
    EXPECT_EQ(row.vector[1], is_known ? 3. : 0.);
    EXPECT_EQ(row.geometry, 7.);
  }



  /// Expect the rows of all places of this rank; @p dropped: without the rows
  /// of every third place.
  void
  expect_rows(const PlaceTable<Row> &table, const bool dropped = false)
  {
    for (unsigned int k = 0; k < table.size(); ++k)
      {
        const unsigned int i = table.places()[k][1];
        expect(table[k], i, !(dropped && i % 3 == 0));
      }
  }



  unsigned int
  n_rows(const PlaceTable<Row> &table)
  {
    constexpr unsigned int n_columns = 3 + 4;
    return MPI::sum(table.rows().size(), all_ranks) / n_columns;
  }



  /// Rows of all ranks, as a checkpoint gives them to each rank.
  std::vector<double>
  all_rows(const PlaceTable<Row> &table)
  {
    std::vector<double> rows;
    for (const auto &of_rank : MPI::all_gather(all_ranks, table.rows()))
      rows.insert(rows.end(), of_rank.begin(), of_rank.end());
    return rows;
  }
} // namespace place_table_test



TEST(PlaceTable, RowsFollowTheirPlaces)
{
  using namespace place_table_test;
  PlaceTable<Row> table = filled(false);
  for (const unsigned int shift : {1, 2, 0})
    {
      table.move_to(places(shift), all_ranks);
      EXPECT_EQ(MPI::sum(table.size(), all_ranks), n_places);
      expect_rows(table);
      EXPECT_EQ(n_rows(table), n_places - 1);
    }
  // The same places, selected among all places with a row.
  const std::vector<PlaceKey> own = places(2);
  table.move_to(
    [&own](const PlaceKey &key) {
      return std::find(own.begin(), own.end(), key) != own.end();
    },
    all_ranks);
  EXPECT_EQ(MPI::sum(table.size(), all_ranks), n_places - 1);
  expect_rows(table);
}



TEST(PlaceTable, DropsOrKeepsRowsWithoutAPlace)
{
  using namespace place_table_test;
  constexpr unsigned int n_partial = n_places - n_places / 3;
  for (const bool outlives : {false, true})
    {
      PlaceTable<Row> moved = filled(outlives), updated = filled(outlives);
      moved.move_to(places(1, true), all_ranks);
      updated.update(places(0, true));
      for (PlaceTable<Row> *const table : {&moved, &updated})
        {
          expect_rows(*table);
          EXPECT_EQ(n_rows(*table), outlives ? n_places - 1 : n_partial);
          table->for_each_elsewhere([](const PlaceKey &key, const Row &row) {
            EXPECT_EQ(int(key[1]) % 3, 0);
            expect(row, key[1]);
          });
          table->move_to(places(2), all_ranks);
          expect_rows(*table, /*dropped=*/!outlives);
        }
    }
}



TEST(PlaceTable, RestoredRowsWaitForTheirPlaces)
{
  using namespace place_table_test;
  for (const bool outlives : {false, true})
    {
      const std::vector<double> rows = all_rows(filled(outlives));
      // Before there are places.
      PlaceTable<Row> table(outlives);
      table.restore(rows);
      EXPECT_TRUE(table.is_waiting());
      EXPECT_EQ(table.rows(), rows);
      table.move_to(places(1), all_ranks);
      EXPECT_FALSE(table.is_waiting());
      expect_rows(table);
      EXPECT_EQ(n_rows(table), n_places - 1);
      // With places, which have their rows at once.
      PlaceTable<Row> later(outlives);
      later.move_to(places(2, true), all_ranks);
      later.restore(rows);
      expect_rows(later);
      later.update(places(2));
      expect_rows(later);
      later.move_to(later.places(), all_ranks);
      EXPECT_EQ(n_rows(later), n_places - 1);
      // Rows without a place have no effect.
      later.restore({});
      for (const Row &row : later.all())
        expect(row, 0);
    }
}



TEST(PlaceTable, KeepsTheOrderOfACheckpoint)
{
  using namespace place_table_test;
  std::vector<double> rows;
  for (const double i : {7., 3., 11., 5.})
    rows.insert(rows.end(), {5., i, 2., i, 1., -i, 3.});
  PlaceTable<Row> table;
  table.restore(rows);
  table.move_to([](const PlaceKey &) { return true; }, all_ranks);
  EXPECT_EQ(table.rows(), rows);
  table.clear();
  EXPECT_TRUE(table.rows().empty());
}
