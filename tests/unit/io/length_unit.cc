// SPDX-License-Identifier: LGPL-2.1-or-later
// Names of units as files of surveys write them.

#include <talus/io/length_unit.h>

#include <gtest/gtest.h>

using namespace talus;

TEST(LengthUnit, NamesInFiles)
{
  for (const std::string name : {"m", "metre", "Meters", "METERS", "[m]"})
    EXPECT_EQ(length_of_unit(name), 1.) << name;
  for (const std::string name : {"ft", "foot", "Feet", "international_feet"})
    EXPECT_EQ(length_of_unit(name), 0.3048) << name;
  for (const std::string name :
       {"US survey foot", "us_survey_feet", "Foot_US", "ftUS", "us-ft"})
    EXPECT_EQ(length_of_unit(name), 1200. / 3937.) << name;
  EXPECT_EQ(length_of_unit("cm"), 0.01);
  EXPECT_EQ(length_of_unit("kilometers"), 1000.);
  EXPECT_EQ(length_of_unit("fathoms"), 1.8288);
  for (const std::string name : {"", "1", "Pa", "furlong", "m s-1"})
    EXPECT_EQ(length_of_unit(name), 0.) << name;
}
