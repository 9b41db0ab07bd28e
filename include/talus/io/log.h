// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_log_h
#define talus_io_log_h

#include <talus/io/files.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// True if standard output is a terminal.
  bool
  stdout_is_terminal();



  /// Who is to see a sentence.
  enum class LogLevel
  {
    detail, ///< who reads log.txt
    info,   ///< and who watches the run on a terminal
    result  ///< and who keeps its standard output
  };



  /// What a run has to say, written by the first rank: to log.txt, as soon as
  /// that is open, and to standard output.
  class Log
  {
  public:
    /// Open log.txt in @p folder, on the first rank. Throws ExcUser if that
    /// fails.
    void
    open(const std::filesystem::path &folder, Beginning beginning);

    void
    say(LogLevel level, const std::string &sentence);

  private:
    LogFile file_;
    bool    is_open_ = false;
  };
} // namespace talus

#endif
