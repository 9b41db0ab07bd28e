// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/remark.h>

#include <algorithm>
#include <cctype>

namespace talus
{
  std::string
  Remark::text() const
  {
    // A sentence may begin with the name of a file.
    if (subject.empty())
      return sentence;
    std::string result = subject + ": " + sentence;
    result.front()     = static_cast<char>(std::toupper(result.front()));
    return result;
  }



  std::vector<Remark>
  joined(const std::vector<Remark> &remarks)
  {
    std::vector<Remark> result;
    for (const Remark &remark : remarks)
      {
        const auto known =
          std::find_if(result.begin(), result.end(), [&](const Remark &other) {
            return other.sentence == remark.sentence &&
                   other.severity == remark.severity;
          });
        if (known != result.end() && known->subject != remark.subject)
          known->subject += ", " + remark.subject;
        else if (known == result.end() && !remark.sentence.empty())
          result.push_back(remark);
      }
    return result;
  }
} // namespace talus
