// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/did_you_mean.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace talus
{
  namespace
  {
    /// Levenshtein's distance: row by row of the table of the distances of all
    /// beginnings.
    std::size_t
    distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          std::size_t diagonal = i;
          row[0]               = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const std::size_t changed =
                diagonal + (std::tolower(a[i]) != std::tolower(b[j]));
              diagonal   = row[j + 1];
              row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }
  } // namespace



  std::string
  did_you_mean(const std::string &word, const std::vector<std::string> &names)
  {
    std::size_t smallest = word.size() / 3 + 1;
    std::string nearest;
    for (const std::string &name : names)
      if (const std::size_t d = distance(word, name); d < smallest)
        {
          smallest = d;
          nearest  = name;
        }
    return nearest.empty() ? "" : " Did you mean '" + nearest + "'?";
  }
} // namespace talus
