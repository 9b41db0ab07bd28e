// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_interrupt_h
#define talus_base_interrupt_h

#include <string>

namespace talus
{
  /// From now on SIGTERM, SIGINT, SIGUSR1, SIGHUP and SIGXCPU do not end the
  /// program but are remembered. A second SIGINT (Ctrl-C) ends it at once.
  void
  remember_signals();

  /// Name of the signal that came since, the last one; empty if none did.
  std::string
  remembered_signal();
} // namespace talus

#endif
