// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_log_h
#define talus_io_log_h

#include <talus/base/remark.h>
#include <talus/base/state_list.h>
#include <talus/io/files.h>

#include <mpi.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Return whether standard output is a terminal.
  bool
  stdout_is_terminal();



  /// Readers of a sentence.
  enum class LogLevel
  {
    detail, ///< readers of log.txt
    info,   ///< also users who watch the run on a terminal
    result  ///< also readers of the standard output of a batch system
  };



  /// Messages of a run, written by the first rank: to log.txt from open() on,
  /// and to standard output.
  class Log
  {
  public:
    explicit Log(const MPI_Comm communicator)
      : communicator_(communicator)
    {}

    /// Open log.txt in @p folder on the first rank. Throws ExcUser on failure.
    void
    open(const std::filesystem::path &folder, Beginning beginning);

    void
    say(LogLevel level, const std::string &sentence);

    /// Report a possible mistake in the input, or an impairment of the results:
    /// "Remark 3: ...", always on standard output; information goes to the file
    /// only, without a number. The numbers continue in a resumed run.
    void
    remark(const Remark &remark);

    /// Return the number of remarks in words; empty if there are none. For the
    /// first rank.
    std::string
    count_of_remarks() const;

    /// Add the number of remarks to the state of the run.
    void
    list_state(StateList &list)
    {
      // Remarks are counted by the first rank; all higher ranks have zero.
      list.add("remarks", "-", n_remarks_, Reduction::sum);
      list.add("remarks on wrong results", "-", n_wrong_, Reduction::sum);
    }

  private:
    MPI_Comm      communicator_;
    LogFile       file_;
    bool          is_open_   = false;
    unsigned long n_remarks_ = 0;
    unsigned long n_wrong_   = 0; ///< remarks on results that must not be used
  };
} // namespace talus

#endif
