#ifndef talus_base_interrupt_h
#define talus_base_interrupt_h

#include <string>

namespace talus
{
  /// What a rank wants to happen after a step. The largest wish of all ranks is
  /// what is done, so that they do the same.
  enum class Wish : unsigned int
  {
    none       = 0,
    checkpoint = 1, ///< write one and go on
    stop       = 2  ///< write one and end
  };

  /// From now on SIGTERM, SIGINT and SIGUSR1 do not end the program but are
  /// remembered. A second SIGINT (Ctrl-C) ends it at once.
  void
  remember_signals();

  /// Name of the signal that came since, the last one; empty if none did.
  std::string
  remembered_signal();
} // namespace talus

#endif
