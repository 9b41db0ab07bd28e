// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_processor_h
#define talus_base_processor_h

#include <string>

namespace talus
{
  /// Description of the instruction set of the running kernels, for the log.
  /// The loader chooses among libraries for several instruction sets; this
  /// header is independent of the choice.
  std::string
  processor();
} // namespace talus

#endif
