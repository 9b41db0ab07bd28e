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
  /// releases the lock at any end of the program.
  class FolderLock
  {
  public:
    FolderLock() = default;
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;

    /// Make the folder if there is none, and lock the folder. Throws ExcUser
    /// with host and process if another run holds the lock. There is no lock on
    /// file systems without locks. Collective.
    void
    acquire(const std::filesystem::path &folder, MPI_Comm communicator);

    /// Leave the file `lock` in the folder. Without this call a new file is
    /// removed again: the run was refused.
    void
    keep()
    {
      new_file_.clear();
    }

  private:
    int file_ = -1; ///< descriptor, on the first rank
    /// File that did not exist before acquire(), on the first rank.
    std::filesystem::path new_file_;
  };



  /// Throw ExcUser if the folder does not exist and cannot be made, or cannot
  /// be written. Leaves no file behind.
  void
  check_can_be_made(const std::filesystem::path &folder);



  /// Return the reason why a run must not write into the folder, a sentence:
  /// the run would write over files of the user or over input of the run, see
  /// protect_input(). Empty without a reason. For the first rank.
  std::string
  foreign_file(const std::filesystem::path &folder, Beginning beginning);



  /// Remove results of an earlier run. A fresh run removes all results except
  /// parameters.prm and the checkpoints: no old result may look like a new
  /// result. A resumed run removes unfinished files, NAME.part, and the last
  /// state before an error. Throws ExcUser. For the first rank.
  void
  remove_results(const std::filesystem::path &folder, Beginning beginning);
} // namespace talus

#endif
