// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/io/hdf5_file.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Silence the library at the end of the program, too: objects of a damaged
    /// file that could not be read cannot be closed either.
    Hdf5Errors
    silent_errors()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      return Hdf5Errors();
    }
  } // namespace



  Hdf5File::Hdf5File(const std::filesystem::path &path,
                     const MPI_Comm               communicator)
    : path_(path)
    , communicator_(communicator)
    , errors_(silent_errors())
  {}



  Hdf5Handle
  Hdf5File::access_properties() const
  {
    Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_mpio(access, communicator_, MPI_INFO_NULL);
    // Metadata are read by one rank and broadcast, and written together;
    // otherwise each rank would ask the file system for each group and
    // attribute.
    H5Pset_all_coll_metadata_ops(access, true);
    H5Pset_coll_metadata_write(access, true);
    // No blocks allocated ahead: MPI-IO fills the unused part of a block with
    // arbitrary content of its buffers, and files of equal runs would differ.
    H5Pset_meta_block_size(access, 0);
    H5Pset_small_data_block_size(access, 0);
    // Metadata have checksums from version 1.8 on.
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
    return access;
  }



  void
  Hdf5File::note_error(const std::string &failure)
  {
    if (own_error_.empty())
      own_error_ = failure;
  }



  /// The first failure stays: later failures mostly follow from the first.
  void
  Hdf5File::note_error(const bool success, const std::string &failure)
  {
    if (!success)
      note_error(failure + " (HDF5: " + errors_.reason() + ")");
  }



  bool
  Hdf5File::check_on_all_ranks()
  {
    error_ = first_sentence(own_error_, communicator_);
    return error_.empty();
  }



  bool
  Hdf5File::check_on_all_ranks(const bool success, const std::string &failure)
  {
    note_error(success, failure);
    return check_on_all_ranks();
  }



  /// MPI_Scan() sums up to and including this rank.
  std::pair<std::uint64_t, std::uint64_t>
  Hdf5File::first_and_total(const std::uint64_t n_rows) const
  {
    std::uint64_t end = 0;
    const int     status =
      MPI_Scan(&n_rows, &end, 1, MPI_UINT64_T, MPI_SUM, communicator_);
    AssertThrowMPI(status);
    return {end - n_rows, Utilities::MPI::sum(n_rows, communicator_)};
  }



  std::pair<std::uint64_t, std::uint64_t>
  Hdf5File::share_of_rank(const std::uint64_t n_rows) const
  {
    const std::uint64_t n     = Utilities::MPI::n_mpi_processes(communicator_);
    const std::uint64_t rank  = Utilities::MPI::this_mpi_process(communicator_);
    const std::uint64_t first = n_rows * rank / n;
    return {first, n_rows * (rank + 1) / n - first};
  }
} // namespace talus
