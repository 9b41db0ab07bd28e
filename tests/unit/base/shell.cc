// SPDX-License-Identifier: LGPL-2.1-or-later
// Words of commands that a user pastes: a shell reads the word itself.

#include <talus/base/shell.h>

#include <gtest/gtest.h>

#include <cstdio>

using namespace talus;

TEST(Shell, WordsComeBack)
{
  EXPECT_EQ(for_shell("output/slide-2_a.tif"), "output/slide-2_a.tif");
  for (const std::string word : {"",
                                 "ut & a",
                                 "o #3",
                                 "it's",
                                 "$HOME `ls` \"x\" \\",
                                 "~/a",
                                 "S\xc3\xa3o"})
    {
      FILE *const shell = popen(("printf %s " + for_shell(word)).c_str(), "r");
      std::string result;
      for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell))
        result += static_cast<char>(c);
      pclose(shell);
      EXPECT_EQ(result, word);
    }
}
