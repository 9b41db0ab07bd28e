#ifndef talus_io_hdf5_writer_h
#define talus_io_hdf5_writer_h

#include <talus/io/hdf5_errors.h>
#include <talus/io/hdf5_handle.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// An HDF5 file that all ranks write together, table by table.
  ///
  /// The file has its name only from finish() on, when all of it was written;
  /// if anything fails before, an older file of that name survives and nothing
  /// else is left. It holds no dates: the same data on the same number of ranks
  /// gives the same bytes.
  ///
  /// The HDF5 library does not survive a full disk: with one rank it crashes at
  /// the end of the program, with several it waits for ever. Therefore the
  /// space for each table is reserved before it is written, as if it could not
  /// be compressed.
  ///
  /// All members are collective. They throw ExcUser, on all ranks or on none.
  /// (deal.II's DataOutBase::write_hdf5_parallel() keeps three of the nine
  /// components of a tensor, refuses names with a slash as in "m/s", fails if
  /// no rank has any data, and writes in place.)
  class Hdf5Writer
  {
  public:
    using Attributes = std::vector<std::pair<std::string, std::string>>;

    Hdf5Writer(const std::filesystem::path &path, MPI_Comm communicator);

    Hdf5Writer(const Hdf5Writer &) = delete;
    Hdf5Writer &
    operator=(const Hdf5Writer &) = delete;

    ~Hdf5Writer() = default;

    /// Give the file an attribute.
    void
    add_number(const std::string &name, double value);

    /// Make a group; "a/b" needs group "a".
    void
    add_group(const std::string &name);

    /// Add a dataset with @p n_columns columns (if 1: a list), the rows of all
    /// ranks after each other. @p values are the rows of this rank, if any.
    void
    add_table(const std::string        &name,
              const std::vector<float> &values,
              unsigned int              n_columns,
              const Attributes         &attributes);

    /// The same with whole numbers.
    void
    add_table(const std::string               &name,
              const std::vector<std::int64_t> &values,
              unsigned int                     n_columns,
              const Attributes                &attributes);

    /// Close the file and give it its name.
    void
    finish();

  private:
    /// Data, their type in memory and, the same on all machines, in the file.
    struct Table
    {
      const void  *data;
      hid_t        memory_type;
      hid_t        file_type;
      hsize_t      n_rows;
      unsigned int n_columns;
    };

    void
    write_table(const std::string &name,
                const Table       &table,
                const Attributes  &attributes);

    Hdf5Handle
    create_dataset(const std::string &name,
                   const Table       &table,
                   hsize_t            n_rows_of_all) const;

    bool
    write_rows(hid_t dataset, const Table &table, hsize_t first_row) const;

    /// Reserve disk space for @p n_bytes more, and for what the library needs
    /// for itself.
    void
    reserve(std::uint64_t n_bytes) const;

    /// Throw, on all ranks, unless all ranks are well.
    void
    agree(bool well) const;

    /// Throw, on all ranks, unless the complaint is empty on all ranks.
    void
    conclude(const std::string &complaint) const;

    /// The name of the file while it is written. Goes last, after the file was
    /// closed, and takes the file with it unless that was renamed.
    struct Part
    {
      ~Part();

      std::filesystem::path path;
      bool                  is_mine; ///< on one rank
    };

    const std::filesystem::path path_;
    const MPI_Comm              communicator_;
    const unsigned int          rank_;
    const unsigned int          n_ranks_;
    const Part                  part_;
    const Hdf5Errors            errors_;
    Hdf5Handle                  file_;
    std::uint64_t               n_bytes_ = 0; ///< size of the file, at most
  };
} // namespace talus

#endif
