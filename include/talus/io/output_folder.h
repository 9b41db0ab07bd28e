// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_output_folder_h
#define talus_io_output_folder_h

#include <talus/io/files.h>

#include <mpi.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Exclusive lock on an output folder for the lifetime of this object. The
  /// first rank locks the file `lock` in the folder; the operating system
  /// releases the lock when the program ends, in whatever way.
  class FolderLock
  {
  public:
    FolderLock() = default;
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;

    /// Make the folder if it does not exist, and lock the folder. Throws
    /// ExcUser with host and process if another run holds the lock. On a file
    /// system without locks nothing is locked. Collective.
    void
    acquire(const std::filesystem::path &folder, MPI_Comm communicator);

  private:
    int file_ = -1; ///< descriptor, on the first rank
  };



  /// Throw ExcUser if the folder does not exist and cannot be made, or cannot
  /// be written. Leaves nothing there.
  void
  check_can_be_made(const std::filesystem::path &folder);



  /// Return a sentence if a run must not write into the folder, because the run
  /// would write over files of the user or over input of the run, see
  /// protect_input(); else an empty string. For the first rank.
  std::string
  foreign_file(const std::filesystem::path &folder, Beginning beginning);



  /// Remove results of an earlier run, for the first rank. A fresh run removes
  /// all results except parameters.prm, so that no old result looks like a new
  /// one; checkpoints are not touched. A resumed run removes unfinished files,
  /// NAME.part, and the last state before an error. Throws ExcUser.
  void
  remove_results(const std::filesystem::path &folder, Beginning beginning);
} // namespace talus

#endif
