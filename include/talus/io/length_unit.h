// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_length_unit_h
#define talus_io_length_unit_h

#include <string>

namespace talus
{
  /// Return the length of a unit that a file names ("m", "US survey foot"), m;
  /// 0 for an unknown name.
  double
  length_of_unit(std::string name);
} // namespace talus

#endif
