// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_folder_lock_h
#define talus_io_folder_lock_h

#include <mpi.h>

#include <filesystem>

namespace talus
{
  /// That no other run writes into an output folder as long as this object
  /// lives. The first rank locks the file `lock` in the folder; the operating
  /// system takes the lock back when the program ends, however it ends.
  class FolderLock
  {
  public:
    FolderLock() = default;
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;

    /// Make the folder if it is not there, and lock it. Throws ExcUser if
    /// another run has it; the sentence says on which host, and which process.
    /// Where the file system knows no locks there is none. Collective.
    void
    acquire(const std::filesystem::path &folder, MPI_Comm communicator);

  private:
    int file_ = -1; ///< descriptor, on the first rank
  };



  /// Why a run must not write into the folder, a sentence, if it holds a `lock`
  /// that no run has written; else empty. For the first rank.
  std::string
  foreign_lock(const std::filesystem::path &folder);
} // namespace talus

#endif
