// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_output_folder_h
#define talus_io_output_folder_h

#include <talus/io/files.h>

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



  /// Why a run must not write into the folder, a sentence: it holds files that
  /// would be written over but are not of a run, be it what this one reads (see
  /// protect_input()) or files of the user. Empty if there is no reason. For the
  /// first rank.
  std::string
  foreign_file(const std::filesystem::path &folder, Beginning beginning);



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
