// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_did_you_mean_h
#define talus_base_did_you_mean_h

#include <string>
#include <vector>

namespace talus
{
  /// Return " Did you mean 'X'?" with the one of @p names that differs from
  /// @p word by the fewest letters added, left out or changed, upper and lower
  /// case being the same; empty if all differ by more than a third of the
  /// letters.
  std::string
  did_you_mean(const std::string &word, const std::vector<std::string> &names);
} // namespace talus

#endif
