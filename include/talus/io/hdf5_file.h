// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_file_h
#define talus_io_hdf5_file_h

#include <talus/io/hdf5_errors.h>
#include <talus/io/hdf5_handle.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

namespace talus
{
  /// What an HDF5 file that all ranks write together and one that they read
  /// together have in common. All calls are collective.
  ///
  /// Like a stream a file remembers its first failure, on whichever rank that
  /// was: all ranks then know it, and all further calls do nothing. Whoever
  /// writes looks at error() after Hdf5OutputFile::close(), whoever reads
  /// before using what was read.
  ///
  /// (deal.II's own classes look at the return codes of the library in Debug
  /// only; its DataOutBase::write_hdf5_parallel() keeps three of the nine
  /// components of a tensor, refuses names with a slash as in "m/s", fails if
  /// no rank has any data, and writes in place.)
  class Hdf5File
  {
  public:
    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &
    operator=(const Hdf5File &) = delete;

    /// What went wrong first, as a clause without full stop; empty if nothing
    /// did.
    const std::string &
    error() const
    {
      return error_;
    }

    const std::filesystem::path &
    path() const
    {
      return path_;
    }

    MPI_Comm
    communicator() const
    {
      return communicator_;
    }

    /// Where the rows of this rank, @p n_rows, begin among those of all, and
    /// how many there are on all ranks.
    std::pair<std::uint64_t, std::uint64_t>
    first_and_total(std::uint64_t n_rows) const;

    /// Return first and number of the rows of this rank if all ranks together
    /// read @p n_rows rows in nearly equal parts.
    std::pair<std::uint64_t, std::uint64_t>
    share_of_rank(std::uint64_t n_rows) const;

  protected:
    Hdf5File(const std::filesystem::path &path, MPI_Comm communicator);
    ~Hdf5File() = default;

    /// How the ranks open the file.
    Hdf5Handle
    access_properties() const;

    /// Keep in mind what failed on this rank, nothing if that is empty, until
    /// the next agreement: enough where no rank waits for this one.
    void
    note_error(const std::string &failure);
    /// The same of a call to the library, with its reason, unless it had
    /// @p success.
    void
    note_error(bool success, const std::string &failure);

    /// Tell all ranks of the first failure. Returns whether there is none.
    bool
    check_on_all_ranks();
    bool
    check_on_all_ranks(bool success, const std::string &failure);

  private:
    const std::filesystem::path path_;
    const MPI_Comm              communicator_;
    const Hdf5Errors            errors_;
    std::string                 error_;
    std::string                 own_error_;

  protected:
    Hdf5Handle file_;
  };
} // namespace talus

#endif
