// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_log_h
#define talus_io_log_h

#include <talus/base/state_list.h>
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

    /// Say what the user may not have meant, or what the results suffer from:
    /// "Remark 3: ...", on standard output in any case. Remarks are numbered
    /// through the run, resumed or not.
    void
    remark(const std::string &sentence);

    /// Return "1 remark" or the like; empty if there are none. For the first
    /// rank.
    std::string
    count_of_remarks() const;

    /// Add the number of remarks to the state of the run.
    void
    list_state(StateList &list)
    {
      // Remarks are counted by the first rank; the others have zero.
      list.add("remarks", "-", n_remarks_, Reduction::sum);
    }

  private:
    LogFile       file_;
    bool          is_open_   = false;
    unsigned long n_remarks_ = 0;
  };
} // namespace talus

#endif
