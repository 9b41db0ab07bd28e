// The landslide of the paper in full: minutes to an hour. Not among the tests
// of every day; see the label `slow`.

#include "landslide.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double all_times = 30.; // s

  void
  expect_within(const Table       &a,
                const Table       &b,
                const std::string &column,
                const double       end,
                const double       tolerance)
  {
    const double difference = relative_difference(a, b, column, end);
    std::cout << column << " to " << end << " s: difference " << difference
              << ", gate " << tolerance << '\n';
    EXPECT_LE(difference, tolerance) << column << " to " << end << " s";
  }
} // namespace



// Four-way and stretched splitting, beta 1.4 and 1.7.
TEST(LandslideFourWay, ToRestAndAgainstItsVariants)
{
  const std::string file     = "landslide-quick.prm";
  const Table       four_way = run<2>(file, "landslide-four-way");
  report("four-way", four_way);
  expect_split_landslide(four_way, 0.002, 24., 27.5);

  const Table stretched = run<2>(file,
                                 "landslide-four-way-stretched",
                                 {"Splitting/Directions=stretched"});
  expect_within(stretched, four_way, "front x [m]", all_times, 0.006);

  const Table later =
    run<2>(file, "landslide-beta-1.7", {"Splitting/Threshold=1.7"});
  report("beta = 1.7", later);
  expect_within(later, four_way, "front x [m]", all_times, 0.003);
}



// The paper's own resolution, about 45 minutes, and the same with coarse cells.
TEST(LandslideFull, ToRestAndAgainstCoarseCells)
{
  const Table fine = run<2>("landslide.prm", "landslide-full");
  report("h = 0.2", fine);
  expect_split_landslide(fine, 0.001, 24., 27.5);

  const Table coarse = run<2>("landslide-quick.prm", "landslide-full-coarse");
  expect_within(coarse, fine, "front x [m]", all_times, 0.01);
  expect_within(coarse, fine, "centre x [m]", 16., 0.01);
  expect_within(coarse, fine, "centre x [m]", 20., 0.015);
  expect_within(coarse, fine, "centre x [m]", all_times, 0.02);
}



TEST(LandslideFullUnsplit, Fractures)
{
  const Table table = run<2>("landslide.prm",
                             "landslide-full-unsplit",
                             {"Splitting/Enabled=false"});
  report("h = 0.2, unsplit", table);
  expect_momentum(table);
  expect_energy(table, 0.005, 0.005);
  double most = 0;
  for (unsigned int i = 0; i < table.n_rows(); ++i)
    {
      const double n = table["empty interior cells"][i];
      most           = std::max(most, n);
      if (table["time [s]"][i] >= 10.)
        {
          EXPECT_GT(n, 0) << "t = " << table["time [s]"][i];
        }
    }
  EXPECT_GE(most, 20);
}
