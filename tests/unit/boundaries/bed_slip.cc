// SPDX-License-Identifier: LGPL-2.1-or-later
// Slip of soil over places of a bed, on any rank.

#include <talus/boundaries/bed_slip.h>

#include "ranks_setup.h"
#include "suites.h"

namespace bed_slip_test
{
  TALUS_ALSO_ON_RANKS(BedSlip, 2, 3);

  constexpr unsigned int n_places  = 12;
  const MPI_Comm         all_ranks = MPI_COMM_WORLD;

  unsigned int
  rank()
  {
    return MPI::this_mpi_process(all_ranks);
  }



  /// The places of this rank in partition @p shift; without @p every third of
  /// all places if @p is_partial.
  std::vector<BedPlace<2>>
  places(const unsigned int shift, const bool is_partial = false)
  {
    std::vector<BedPlace<2>> result;
    for (unsigned int i = 0; i < n_places; ++i)
      if ((i + shift) % MPI::n_mpi_processes(all_ranks) == rank() &&
          !(is_partial && i % 3 == 0))
        result.push_back({{{1., double(i), 2., 0.}}, Point<2>(i, 0.), 0.5});
    return result;
  }



  double
  slip_of(const BedPlace<2> &place)
  {
    return 0.1 * place.key[1];
  }



  /// All places with slip are somewhere once, and known places have the slip.
  void
  expect_all(const BedSlip<2> &slip)
  {
    for (unsigned int i = 0; i < slip.places().size(); ++i)
      EXPECT_EQ(slip.state(i).slip, slip_of(slip.places()[i]));
    EXPECT_EQ(slip.slipped_areas(3, all_ranks)[2], 0.5 * (n_places - 1));
    EXPECT_EQ(slip.largest_slips(3, all_ranks)[2], 0.1 * (n_places - 1));
  }



  BedSlip<2>
  slipped()
  {
    BedSlip<2> slip;
    slip.prepare(places(0), all_ranks);
    for (unsigned int i = 0; i < slip.places().size(); ++i)
      slip.add(i, slip_of(slip.places()[i]));
    return slip;
  }
} // namespace bed_slip_test



TEST(BedSlip, BelongsToThePlace)
{
  using namespace bed_slip_test;
  BedSlip<2> slip = slipped();
  expect_all(slip);
  // Other ranks have the places, and the mesh lacks some for a while.
  slip.prepare(places(1, true), all_ranks);
  expect_all(slip);
  slip.update(places(1, false));
  slip.prepare({}, all_ranks);
  expect_all(slip);
  slip.prepare(places(2), all_ranks);
  EXPECT_EQ(MPI::sum(slip.places().size(), all_ranks), n_places);
  expect_all(slip);
}



// The places are known when the checkpoint is read, and keep their keys.
TEST(BedSlip, SurvivesACheckpoint)
{
  using namespace bed_slip_test;
  std::vector<double> rows;
  for (const auto &of_rank : MPI::all_gather(all_ranks, slipped().rows()))
    rows.insert(rows.end(), of_rank.begin(), of_rank.end());
  for (const bool is_partial : {false, true})
    {
      BedSlip<2> slip;
      slip.prepare(places(1, is_partial), all_ranks);
      StateList list;
      slip.list_state("slip", list);
      list.tables().front().set(rows);
      for (unsigned int i = 0; i < slip.places().size(); ++i)
        EXPECT_EQ(slip.state(i).slip, slip_of(slip.places()[i]));
      slip.begin_step(all_ranks);
      expect_all(slip);
    }
}



TEST(BedSlip, RegionOfTheTrigger)
{
  using namespace bed_slip_test;
  BedSlip<2> slip;
  EXPECT_FALSE(slip.has_region());
  slip.set_region([](const Point<2> &x) { return x[0] > 8.5; });
  slip.prepare(places(0), all_ranks);
  EXPECT_EQ(MPI::sum(slip.n_triggered(), all_ranks), 3u);
  for (unsigned int i = 0; i < slip.places().size(); ++i)
    EXPECT_EQ(slip.state(i).is_triggered, slip.places()[i].x[0] > 8.5);
}
