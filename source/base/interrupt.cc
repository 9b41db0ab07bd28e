// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/interrupt.h>

#include <csignal>

namespace talus
{
  namespace
  {
    // The only type that a signal handler may modify.
    volatile std::sig_atomic_t last_signal = 0;

    /// Only store the signal: the time loop queries it between steps, when
    /// state and files are consistent. A checkpoint written by the handler
    /// could interrupt a step or an allocation.
    extern "C" void
    talus_remember_signal(const int signal)
    {
      last_signal = signal;
    }
  } // namespace



  void
  remember_signals()
  {
    last_signal = 0;
    for (const int signal :
         {SIGTERM, SIGINT, SIGUSR1, SIGHUP, SIGXCPU, SIGPIPE})
      {
        struct sigaction before = {};
        sigaction(signal, nullptr, &before);
        // Ignored by `nohup` or by a shell for programs in the background.
        if (before.sa_handler == SIG_IGN)
          continue;
        struct sigaction action = {};
        action.sa_handler       = &talus_remember_signal;
        // An interrupted write is continued.
        action.sa_flags = SA_RESTART;
        // The second Ctrl-C meets the default handler, which ends the program.
        if (signal == SIGINT)
          action.sa_flags |= SA_RESETHAND;
        sigaction(signal, &action, nullptr);
      }
  }



  std::string
  remembered_signal()
  {
    switch (last_signal)
      {
        case 0:
          return "";
        case SIGTERM:
          return "SIGTERM";
        case SIGINT:
          return "SIGINT";
        case SIGHUP:
          return "SIGHUP";
        case SIGXCPU:
          return "SIGXCPU";
        // The reader of the standard output has ended.
        case SIGPIPE:
          return "SIGPIPE";
        default:
          return "SIGUSR1";
      }
  }
} // namespace talus
