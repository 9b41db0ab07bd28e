// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/did_you_mean.h>
#include <talus/base/errors.h>
#include <talus/base/remark.h>
#include <talus/io/log.h>

#include <gtest/gtest.h>

// Equal sentences become one on all subjects; empty ones are left out.
TEST(Remarks, EqualOnesAreJoined)
{
  using namespace talus;
  const auto remarks = joined({{"too thin.", Severity::look, "body 'a'"},
                               {""},
                               {"Nothing moves."},
                               {"too thin.", Severity::wrong, "body 'b'"},
                               {"Nothing moves."},
                               {"too thin.", Severity::look, "body 'c'"}});
  ASSERT_EQ(remarks.size(), 3u);
  EXPECT_EQ(remarks[0].text(), "Body 'a', body 'c': too thin.");
  EXPECT_EQ(remarks[1].text(), "Nothing moves.");
  EXPECT_EQ(remarks[2].text(), "Body 'b': too thin.");
}



TEST(Remarks, SeverityIsTold)
{
  using namespace talus;
  Log log(MPI_COMM_WORLD);
  testing::internal::CaptureStdout();
  log.remark({"On purpose.", Severity::information});
  EXPECT_EQ(log.count_of_remarks(), "");
  log.remark("Look at it.");
  EXPECT_EQ(log.count_of_remarks(), "1 remark");
  log.remark({"Forces are 0.", Severity::wrong});
  EXPECT_EQ(log.count_of_remarks(), "2 remarks, do not use the results");
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "Remark 1: Look at it.\n"
            "Remark 2 (do not use the results): Forces are 0.\n");
}



TEST(Counted, OneHasNoPlural)
{
  using talus::counted;
  EXPECT_EQ(counted(1, "cell"), "1 cell");
  EXPECT_EQ(counted(0, "cell"), "0 cells");
  EXPECT_EQ(counted(1.2499, "cell"), "1.25 cells");
  EXPECT_EQ(counted(12345678, "point"), "12345678 points");
}



TEST(DidYouMean, NearestName)
{
  using talus::did_you_mean;
  const std::vector<std::string> names = {"slip", "mudline", "Cell size"};
  EXPECT_EQ(did_you_mean("mudlin", names), " Did you mean 'mudline'?");
  EXPECT_EQ(did_you_mean("slpi", names), "");
  EXPECT_EQ(did_you_mean("cellsize", names), " Did you mean 'Cell size'?");
  EXPECT_EQ(did_you_mean("x", names), "");
  EXPECT_EQ(did_you_mean("", {}), "");
}
