// SPDX-License-Identifier: LGPL-2.1-or-later
// A slide that thins to a fifth of a cell, tests/cases/thin-slide.prm: points
// must split until it rests, or the log must say that a limit forbids it.

#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

using namespace talus;
using namespace talus::cases;

namespace
{
  constexpr double cell_size = 0.8; // m

  /// Time of the first row with more than @p limit in a column, s; infinity if
  /// there is none.
  double
  time_above(const Table &table, const std::string &column, const double limit)
  {
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      if (table[column][i] > limit)
        return table["time [s]"][i];
    return std::numeric_limits<double>::infinity();
  }



  /// Volume over length at the end, in cells.
  double
  mean_thickness(const Table &table)
  {
    const double density = 600., // kg/m^3
      rear               = 0.;   // m, the wall
    return table["mass [kg]"].back() / density /
           (table["front x [m]"].back() - rear) / cell_size;
  }



  /// How often log.txt of the run @p name says @p words.
  unsigned int
  count_in_log(const std::string &name, const std::string &words)
  {
    std::ifstream      file(std::string(TALUS_RESULTS_DIR) + "/" + name +
                       "/log.txt");
    std::ostringstream content;
    content << file.rdbuf();
    const std::string text = content.str();
    EXPECT_FALSE(text.empty());
    unsigned int n = 0;
    for (std::size_t at = text.find(words); at != std::string::npos;
         at             = text.find(words, at + 1))
      ++n;
    return n;
  }

  const std::string remark = "soil is stretched too far without a split";
} // namespace



TEST(ThinSlide, StaysWholeByDefault)
{
  Verification gates("Slide that thins to a fifth of a cell",
                     "tests/cases/thin-slide.prm",
                     "continuity of the soil");
  const Table  table = run<2>("thin-slide.prm", "thin-slide", {"End time=20"});
  gates.at_most("mean thickness at the end / h", mean_thickness(table), 0.2);
  expect_continuum(gates, table);
  EXPECT_EQ(time_above(table, "points at mesh limit", 0.),
            std::numeric_limits<double>::infinity());
  EXPECT_GT(table["largest generation"].back(), 3.);
  EXPECT_EQ(count_in_log("thin-slide", remark), 0u);
}



// The control: with three generations the same slide tears, and both the table
// and the log say so before it does.
TEST(ThinSlide, TearsAtALimitAndSaysSo)
{
  Verification gates("Slide that thins to a fifth of a cell, 3 generations",
                     "tests/cases/thin-slide.prm, "
                     "Splitting/Maximum generation=3",
                     "continuity of the soil");
  const Table  table   = run<2>("thin-slide.prm",
                             "thin-slide-3",
                             {"Splitting/Maximum generation=3"});
  const auto   largest = [&](const std::string &column) {
    return *std::max_element(table[column].begin(), table[column].end());
  };
  gates.at_least("empty columns, at most",
                 largest("empty columns"),
                 1.,
                 "the slide tears");
  gates.at_least("connected bodies, at most",
                 largest("connected bodies"),
                 2.,
                 "the slide tears");
  const double counted = time_above(table, "points at generation limit", 0.);
  const double torn    = std::min(time_above(table, "empty columns", 0.),
                               time_above(table, "connected bodies", 1.));
  gates.at_most("time of the first point at the limit / time of the first gap",
                counted / torn,
                1.);
  EXPECT_EQ(count_in_log("thin-slide-3", remark), 1u);
}
