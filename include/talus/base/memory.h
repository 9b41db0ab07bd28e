// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_memory_h
#define talus_base_memory_h

namespace talus
{
  /// Bytes that this process can have at most: the memory of the machine, or what
  /// is left if the user's shell or a queue has set a limit (ulimit -v).
  double
  largest_memory();
} // namespace talus

#endif
