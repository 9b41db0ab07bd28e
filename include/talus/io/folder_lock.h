// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_folder_lock_h
#define talus_io_folder_lock_h

#include <mpi.h>

#include <filesystem>

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

    /// Make the folder if there is none, and lock it. Throws ExcUser if another
    /// run has the lock, naming host and process. There is no lock on file
    /// systems without locks. Collective.
    void
    acquire(const std::filesystem::path &folder, MPI_Comm communicator);

  private:
    int file_ = -1; ///< descriptor, on the first rank
  };



  /// Return the reason why a run must not write into the folder, a sentence, if
  /// a file `lock` in the folder was not written by a run; otherwise empty. For
  /// the first rank.
  std::string
  foreign_lock(const std::filesystem::path &folder);
} // namespace talus

#endif
