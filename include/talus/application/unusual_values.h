// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_unusual_values_h
#define talus_application_unusual_values_h

#include <map>
#include <string>
#include <vector>

namespace talus
{
  /// Return a remark for each number among @p values, parameters by path, that
  /// is far from the usual values of the parameter, as after a mistake in the
  /// unit. Entries without a usual range, zeros and expressions get none.
  std::vector<std::string>
  unusual_values(const std::map<std::string, std::string> &values);
} // namespace talus

#endif
