// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/interrupt.h>

#include <csignal>

namespace talus
{
  namespace
  {
    // All that a signal handler may touch.
    volatile std::sig_atomic_t last_signal = 0;

    /// Only notes the signal: whoever leads the run asks for it between two
    /// steps, where state and files are whole. Writing a checkpoint from within
    /// the handler could find a step, or an allocation, half done.
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
        // By `nohup`, or a shell that runs it in the background.
        if (before.sa_handler == SIG_IGN)
          continue;
        struct sigaction action = {};
        action.sa_handler       = &talus_remember_signal;
        // A write that was under way goes on.
        action.sa_flags = SA_RESTART;
        // The second Ctrl-C finds the default handler, which ends the program.
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
        // Whoever read the standard output has gone.
        case SIGPIPE:
          return "SIGPIPE";
        default:
          return "SIGUSR1";
      }
  }
} // namespace talus
