// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_suites_h
#define talus_tests_unit_suites_h

#include <map>
#include <string>
#include <vector>

/// By the name of a suite, the numbers of ranks it is run on besides one.
inline std::map<std::string, std::vector<unsigned int>> &
further_ranks()
{
  static std::map<std::string, std::vector<unsigned int>> ranks;
  return ranks;
}

/// Run the suite on these numbers of ranks, too: once, beside its tests, as in
/// TALUS_ALSO_ON_RANKS(Periodic, 2, 3);
#define TALUS_ALSO_ON_RANKS(suite, ...)                  \
  [[maybe_unused]] const bool suite##_is_on_ranks = [] { \
    further_ranks()[#suite] = {__VA_ARGS__};             \
    return true;                                         \
  }()

#endif
