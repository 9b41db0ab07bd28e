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
  /// Common part of HDF5 files that all ranks write together or read together.
  /// All calls are collective.
  ///
  /// Like a stream, a file keeps the first failure, from any rank: all ranks
  /// then know the failure, and all further calls do nothing. Check error()
  /// after Hdf5OutputFile::close() when writing, before using the data when
  /// reading.
  ///
  /// (deal.II's own classes check the return codes of the library only in
  /// Debug. DataOutBase::write_hdf5_parallel() keeps three of the nine
  /// components of a tensor, refuses names with a slash as in "m/s", fails if
  /// no rank has data, and writes in place.)
  class Hdf5File
  {
  public:
    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &
    operator=(const Hdf5File &) = delete;

    /// Return the first failure, as a clause without full stop; empty without
    /// failure.
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

    /// Return the first row of this rank, which has @p n_rows, among the rows
    /// of all ranks, and the total number of rows.
    std::pair<std::uint64_t, std::uint64_t>
    first_and_total(std::uint64_t n_rows) const;

    /// Return the first row of this rank and the number of rows, if all ranks
    /// together read @p n_rows rows in nearly equal parts.
    std::pair<std::uint64_t, std::uint64_t>
    share_of_rank(std::uint64_t n_rows) const;

  protected:
    Hdf5File(const std::filesystem::path &path, MPI_Comm communicator);
    ~Hdf5File() = default;

    /// Return the properties with which the ranks open the file.
    Hdf5Handle
    access_properties() const;

    /// Keep a failure on this rank (none if the text is empty) until the next
    /// check_on_all_ranks(). Sufficient where no rank waits for this rank.
    void
    note_error(const std::string &failure);
    /// Keep the failure of a call to the library, with the library's reason,
    /// unless @p success.
    void
    note_error(bool success, const std::string &failure);

    /// Tell all ranks the first failure. Returns whether there is none.
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
