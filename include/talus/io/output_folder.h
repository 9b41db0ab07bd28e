// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_output_folder_h
#define talus_io_output_folder_h

#include <talus/io/files.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Return whether a run may write a file of the given name into the output
  /// folder.
  bool
  is_output_name(const std::string &file_name);



  /// Throw ExcUser if the folder does not exist and cannot be made, or cannot
  /// be written. Leaves no file behind.
  void
  check_can_be_made(const std::filesystem::path &folder);



  /// Return the reason why a run must not write into the folder, a sentence:
  /// files in the folder would be overwritten that no run has written, either
  /// inputs of the present run (see protect_input()) or files of the user.
  /// Empty without a reason. For the first rank.
  std::string
  foreign_file(const std::filesystem::path &folder, Beginning beginning);



  /// Remove the results of an earlier run from the folder, except
  /// parameters.prm and the checkpoints: no old result may look like a new
  /// result. For the first rank.
  void
  remove_earlier_results(const std::filesystem::path &folder);



  /// Remove remains of a killed or failed run: unfinished files NAME.part, and
  /// the last state before an error, which does not belong to the continued
  /// run. For the first rank.
  void
  remove_remains(const std::filesystem::path &folder);
} // namespace talus

#endif
