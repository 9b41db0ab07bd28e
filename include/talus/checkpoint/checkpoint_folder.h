// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_checkpoint_folder_h
#define talus_checkpoint_checkpoint_folder_h

#include <talus/checkpoint/checkpoint_content.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  // A checkpoint is a folder `checkpoints/STEP` in the output folder. It is
  // written under a temporary name and renamed when complete and on disk, so a
  // folder with a proper name is complete. Only folders with files of a
  // checkpoint are considered, and only files of checkpoints are ever removed:
  // all other files belong to the user. Unless stated otherwise the functions
  // below are called on one rank; functions that can fail return an error
  // message, empty on success.

  /// Folder of the checkpoint of step @p step.
  std::filesystem::path
  checkpoint_path(const std::filesystem::path &output_folder,
                  unsigned long                step);

  /// Folder in which @p checkpoint is written before its renaming.
  std::filesystem::path
  temporary_path(const std::filesystem::path &checkpoint);

  /// All complete checkpoints, newest first.
  std::vector<std::filesystem::path>
  find_checkpoints(const std::filesystem::path &output_folder);

  /// Remove the incomplete checkpoints of a killed run.
  void
  remove_unfinished(const std::filesystem::path &output_folder);

  /// Create the empty folder temporary_path(@p checkpoint).
  std::string
  make_temporary_folder(const std::filesystem::path &checkpoint);

  /// Write all files in a folder, and the directory entries, to disk.
  std::string
  sync_folder(const std::filesystem::path &folder);

  /// Rename the complete temporary folder to @p checkpoint.
  std::string
  commit(const std::filesystem::path &checkpoint);

  /// Remove all checkpoints except those in @p kept.
  void
  remove_checkpoints_but(const std::filesystem::path &output_folder,
                         const std::vector<std::filesystem::path> &kept);



  /// Checkpoint that can be loaded.
  struct FoundCheckpoint
  {
    std::filesystem::path path;
    CheckpointHead        head;
    /// A sentence for each newer, damaged checkpoint.
    std::vector<std::string> errors;
  };



  /// Find the newest checkpoint in the output folder whose content matches its
  /// checksums. Throws ExcUser if none exists, or if format or dimension
  /// differ. Collective.
  FoundCheckpoint
  find_checkpoint(const std::filesystem::path &output_folder,
                  unsigned int                 dimension,
                  MPI_Comm                     communicator);



  /// Throw ExcUser if the output folder holds a checkpoint of an unfinished
  /// run: a forgotten --resume must not overwrite days of computing.
  /// Collective.
  void
  check_nothing_unfinished(const std::filesystem::path &output_folder,
                           MPI_Comm                     communicator);
} // namespace talus

#endif
