// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/log.h>

#include <iostream>

#include <unistd.h>

namespace talus
{
  /// Progress is shown only on a terminal, and not in the log of a batch
  /// system.
  bool
  stdout_is_terminal()
  {
    return isatty(STDOUT_FILENO);
  }



  /// Only the first rank has the file. Earlier messages are only on the
  /// terminal.
  void
  Log::open(const std::filesystem::path &folder, const Beginning beginning)
  {
    if (!is_first_rank(communicator_))
      return;
    file_.open(folder / "log.txt", beginning);
    is_open_ = true;
  }



  /// Results are always printed, information only on a terminal; the file has
  /// both levels.
  void
  Log::say(const LogLevel level, const std::string &sentence)
  {
    if (!is_first_rank(communicator_))
      return;
    if (is_open_)
      file_.add_line(sentence);
    if (level == LogLevel::result ||
        (level == LogLevel::info && stdout_is_terminal()))
      std::cout << sentence << std::endl;
  }



  void
  Log::remark(const Remark &remark)
  {
    if (!is_first_rank(communicator_))
      return;
    if (remark.severity == Severity::information)
      return say(LogLevel::detail, remark.text());
    const bool is_wrong = (remark.severity == Severity::wrong);
    ++n_remarks_;
    n_wrong_ += is_wrong;
    say(LogLevel::result,
        text("Remark ",
             n_remarks_,
             is_wrong ? " (do not use the results): " : ": ",
             remark.text()));
  }



  std::string
  Log::count_of_remarks() const
  {
    return n_remarks_ == 0
             ? ""
             : counted(n_remarks_, "remark") +
                 (n_wrong_ == 0 ? "" : ", do not use the results");
  }
} // namespace talus
