// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbers that are hardly ever meant.

#include <talus/application/unusual_values.h>

#include <gtest/gtest.h>

using talus::unusual_values;

namespace
{
  /// Return the remark on the entry; empty if there is none.
  std::string
  remark_on(const std::string                 &path,
            const std::string                 &value,
            std::map<std::string, std::string> values = {})
  {
    values[path]       = value;
    const auto remarks = unusual_values(values);
    EXPECT_LE(remarks.size(), 1u);
    return remarks.empty() ? "" : remarks[0];
  }



  TEST(UnusualValues, AreRemarked)
  {
    EXPECT_EQ(remark_on("Materials/clay/Density", "1e-6"),
              "'Materials/clay/Density' is 1e-06 kg/m^3, where 0.1 to 30000 "
              "kg/m^3 are usual. Look at the number and its unit.");
    for (const auto &[path, value] :
         {std::pair("Materials/clay/Density", "6e8"),
          std::pair("Materials/mud/Consistency", "5e8"),
          std::pair("Water/Added mass coefficient", "1000"),
          std::pair("Boundaries/Seabed/Slip to remould", "1e-300"),
          std::pair("Obstacles/bed/Slip to remould", "1e-300"),
          std::pair("Obstacles/pile/Mass", "1e15")})
      EXPECT_NE(remark_on(path, value), "") << path;
    for (const auto &[path, value] :
         {std::pair("Materials/clay/Density", "1"),
          std::pair("Materials/clay/Density", ""),
          std::pair("Materials/clay/Density", "1e9 + x"),
          std::pair("Obstacles/bed/Slip to remould", "0"),
          std::pair("Materials/clay/Submerged density", "1e-6"),
          std::pair("Output/Plan interval", "1e9")})
      EXPECT_EQ(remark_on(path, value), "") << path;
  }



  TEST(UnusualValues, AreMeasuredByRunAndMesh)
  {
    const std::map<std::string, std::string> run = {
      {"End time", "100"},
      {"Grid/Lower corner", "-100, 0"},
      {"Grid/Upper corner", "400, 20"}};
    EXPECT_EQ(remark_on("Maps/Cell size", "500", run), "");
    EXPECT_NE(remark_on("Maps/Cell size", "501", run), "");
    EXPECT_EQ(remark_on("Output/Plan interval", "100", run), "");
    EXPECT_NE(remark_on("Output/Plan interval", "101", run), "");
  }
} // namespace
