// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_output_folder_h
#define talus_io_output_folder_h

#include <filesystem>
#include <string>

namespace talus
{
  /// Whether a run may write a file of this name into its output folder.
  bool
  is_output_name(const std::string &file_name);



  /// Throw ExcUser if the folder is not there and cannot be made, or cannot be
  /// written. Leaves nothing there.
  void
  check_can_be_made(const std::filesystem::path &folder);



  /// Throw ExcUser if the folder holds files that a run would write over but
  /// that are not of a run: what this one reads (see protect_input()), or a
  /// parameters.prm of the user. For the first rank.
  void
  check_no_foreign_file(const std::filesystem::path &folder);



  /// Throw ExcUser if the folder, in which no run has left a parameters.prm, holds
  /// files named as those of a run: nobody knows whose they are. For the first rank.
  void
  check_no_results_without_a_run(const std::filesystem::path &folder);



  /// Remove what an earlier run left in the folder but for parameters.prm, so that
  /// nothing of it looks as if it were of the new one; its checkpoints are not
  /// touched. For the first rank.
  void
  remove_earlier_results(const std::filesystem::path &folder);



  /// Remove what a run that was killed or failed left beside its results: files
  /// that it was about to write, NAME.part, and the last state before an error,
  /// which is not that of the run that goes on. For the first rank.
  void
  remove_remains(const std::filesystem::path &folder);
} // namespace talus

#endif
