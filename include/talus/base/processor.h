// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_processor_h
#define talus_base_processor_h

#include <string>

namespace talus
{
  /// What the kernels that run were compiled for, for people. Nothing in this
  /// header depends on it: of several libraries the loader chooses one.
  std::string
  processor();
} // namespace talus

#endif
