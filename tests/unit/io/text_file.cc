// SPDX-License-Identifier: LGPL-2.1-or-later
// Texts are UTF-8, with or without the mark; the message names the line.

#include <talus/base/errors.h>
#include <talus/io/text_file.h>

#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

using namespace talus;
namespace fs = std::filesystem;

TEST(TextFile, Utf8WithAndWithoutMark)
{
  const fs::path path =
    fs::temp_directory_path() / ("talus-text-" + std::to_string(getpid()));
  const auto read = [&](const std::string &content) {
    std::ofstream(path, std::ios::binary) << content;
    return read_text_file(path).value();
  };
  const std::string text = "# S\xc3\xa3o Miguel, 5\xc2\xb0\nEnd\n";
  EXPECT_EQ(read(text), text);
  EXPECT_EQ(read("\xef\xbb\xbf" + text), text);
  EXPECT_EQ(read(""), "");
  for (const std::string &wrong :
       {std::string("one\ntwo\nS\xe3o Miguel\n"),        // cp1252
        std::string("one\ntwo\n\xc3"),                   // cut off
        std::string("one\ntwo\n\xed\xa0\x80 surrogate"), // no character
        std::string("one\ntwo\n\xc0\xaf too long")})
    try
      {
        read(wrong);
        FAIL() << wrong;
      }
    catch (const ExcUser &error)
      {
        EXPECT_NE(std::string(error.what())
                    .find(path.string() + "', line 3, is not UTF-8"),
                  std::string::npos)
          << error.what();
      }
  fs::remove(path);
}
