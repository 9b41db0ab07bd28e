// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/text_file.h>

#include <boost/locale/utf.hpp>

#include <algorithm>
#include <fstream>
#include <vector>

namespace talus
{
  // Tools read the record of the parameters as UTF-8, after the run.
  void
  check_utf8(const std::string &name, const std::string &content)
  {
    using Utf8 = boost::locale::utf::utf_traits<char>;
    for (auto at = content.begin(); at != content.end();)
      {
        const auto begin = at;
        AssertThrow(boost::locale::utf::is_valid_codepoint(
                      Utf8::decode(at, content.end())),
                    ExcUser(text(name,
                                 ", line ",
                                 std::count(content.begin(), begin, '\n') + 1,
                                 ", is not UTF-8. Save the text as UTF-8.")));
      }
  }



  // The type of the file is checked before opening: opening a pipe waits for a
  // writer. A pipe or a sparse file may have more bytes than the memory, hence
  // the limit.
  std::optional<std::string>
  read_text_file(const std::filesystem::path &file, const Pipes pipes)
  {
    namespace fs                  = std::filesystem;
    constexpr std::size_t largest = 100'000'000;
    std::error_code       error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::is_regular_file(status) &&
        !(pipes == Pipes::read && fs::is_fifo(status)))
      return {};
    std::ifstream in(file, std::ios::binary);
    if (!in)
      return {};
    std::string       content;
    std::vector<char> block(1 << 16);
    while (in)
      {
        in.read(block.data(), block.size());
        content.append(block.data(), in.gcount());
        AssertThrow(content.size() <= largest,
                    ExcUser("The file '" + file.string() +
                            "' has more than 100 MB, where parameters or a "
                            "table were expected. Give the path of such a "
                            "file."));
      }
    if (!in.eof())
      return {};
    if (content.rfind("\xef\xbb\xbf", 0) == 0)
      content.erase(0, 3); // byte order mark of UTF-8
    check_utf8("The file '" + file.string() + "'", content);
    return content;
  }
} // namespace talus
