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
  // written under another name and renamed when it is complete and on the disk,
  // so that whatever has a proper name is whole. Only such folders, with files of
  // a checkpoint in them, are looked at, and only those files are ever removed:
  // what else lies there is the user's. Unless said otherwise one rank
  // calls what follows; functions that may fail return why, empty if they did
  // not.

  /// The folder of the checkpoint of step @p step.
  std::filesystem::path
  checkpoint_path(const std::filesystem::path &output_folder,
                  unsigned long                step);

  /// Where that checkpoint is written.
  std::filesystem::path
  temporary_path(const std::filesystem::path &checkpoint);

  /// All checkpoints, the newest first, without what was left half-written.
  std::vector<std::filesystem::path>
  find_checkpoints(const std::filesystem::path &output_folder);

  /// Remove what a killed run left half-written.
  void
  remove_unfinished(const std::filesystem::path &output_folder);

  /// Make the empty folder temporary_path(@p checkpoint).
  std::string
  make_temporary_folder(const std::filesystem::path &checkpoint);

  /// Bring all files in a folder, and their names, to the disk.
  std::string
  sync_folder(const std::filesystem::path &folder);

  /// Give the complete checkpoint its name.
  std::string
  commit(const std::filesystem::path &checkpoint);

  /// Remove all checkpoints but these.
  void
  remove_checkpoints_but(const std::filesystem::path &output_folder,
                         const std::vector<std::filesystem::path> &kept);



  /// A checkpoint that can be loaded.
  struct FoundCheckpoint
  {
    std::filesystem::path path;
    CheckpointHead        head;
    /// One sentence for each newer one that is damaged.
    std::vector<std::string> errors;
  };



  /// The newest checkpoint in the output folder whose content agrees with its
  /// checksums. Throws ExcUser if there is none, or if it is of another format
  /// or dimension. Collective.
  FoundCheckpoint
  find_checkpoint(const std::filesystem::path &output_folder,
                  unsigned int                 dimension,
                  MPI_Comm                     communicator);



  /// Throw ExcUser if the output folder holds the checkpoint of a run that did
  /// not reach its end: days of computing are not to be overwritten by a
  /// forgotten --resume. Collective.
  void
  check_nothing_unfinished(const std::filesystem::path &output_folder,
                           MPI_Comm                     communicator);
} // namespace talus

#endif
