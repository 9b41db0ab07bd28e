// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_interrupt_h
#define talus_base_interrupt_h

#include <string>

namespace talus
{
  /// Install handlers: SIGTERM, SIGINT, SIGUSR1, SIGHUP, SIGXCPU and SIGPIPE no
  /// longer end the program but are remembered. A second SIGINT (Ctrl-C) ends
  /// the program at once.
  void
  remember_signals();

  /// Name of the last signal since remember_signals(); empty if none arrived.
  std::string
  remembered_signal();
} // namespace talus

#endif
