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
#include <vector>

namespace talus
{
  /// What a new HDF5 file is to be.
  struct Hdf5Options
  {
    /// Arrays of doubles and texts get an attribute `checksum`; see checksum.h.
    bool has_checksums = true;
    /// Arrays are compressed.
    bool is_compressed = false;
    /// The file has its name only from close() on, when all of it was written
    /// and is on the disk. If anything fails before, an older file of that name
    /// survives and nothing else is left.
    bool is_atomic = false;
  };



  /// An HDF5 file that all ranks write or read together. All calls are
  /// collective.
  ///
  /// Like a stream it remembers its first failure, on whichever rank that was:
  /// all ranks then know it, and all further calls do nothing. Whoever writes
  /// looks at error() after close(), whoever reads before using what was read.
  ///
  /// The HDF5 library does not survive a full disk: with one rank it crashes at
  /// the end of the program, with several it waits for ever. Therefore the
  /// space for each array is reserved before it is written, as if it could not
  /// be compressed.
  ///
  /// What a file claims to hold is compared with what is expected before
  /// anything of it is read: it may be damaged, or made by others.
  ///
  /// There are no dates in the file: the same data on the same number of ranks
  /// give the same bytes. Its own metadata have checksums (HDF5 1.8 or later
  /// reads it).
  ///
  /// (deal.II's own classes look at the return codes of the library in Debug
  /// only; its DataOutBase::write_hdf5_parallel() keeps three of the nine
  /// components of a tensor, refuses names with a slash as in "m/s", fails if
  /// no rank has any data, and writes in place.)
  class Hdf5File
  {
  public:
    enum class Access
    {
      create, ///< a new file, over an older one of that name
      read
    };

    Hdf5File(const std::filesystem::path &path,
             Access                       access,
             MPI_Comm                     communicator,
             const Hdf5Options           &options = {});

    /// A file that was not closed is not complete.
    ~Hdf5File();

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

    /// Complete the file, bring it to the disk and give it its name.
    void
    close();

    /// Make a group; "a/b" needs group "a".
    void
    create_group(const std::string &name);

    /// What is in a group, by name, sorted.
    std::vector<std::string>
    names(const std::string &group);

    /// Attribute of the group or array @p object; "/" is the file.
    void
    set_attribute(const std::string &object,
                  const std::string &name,
                  const std::string &value);
    void
    set_attribute(const std::string &object,
                  const std::string &name,
                  const double       value)
    {
      write_attribute(object, name, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, &value);
    }
    void
    set_attribute(const std::string  &object,
                  const std::string  &name,
                  const std::uint64_t value)
    {
      write_attribute(object, name, H5T_NATIVE_UINT64, H5T_STD_U64LE, &value);
    }

    std::string
    text_attribute(const std::string &object, const std::string &name);

    double
    number_attribute(const std::string &object, const std::string &name)
    {
      return read_attribute<double>(object,
                                    name,
                                    H5T_NATIVE_DOUBLE,
                                    H5T_IEEE_F64LE);
    }

    std::uint64_t
    integer_attribute(const std::string &object, const std::string &name)
    {
      return read_attribute<std::uint64_t>(object,
                                           name,
                                           H5T_NATIVE_UINT64,
                                           H5T_STD_U64LE);
    }

    /// Where the rows of this rank, @p n_rows, begin among those of all, and
    /// how many there are on all ranks.
    std::pair<std::uint64_t, std::uint64_t>
    first_and_total(std::uint64_t n_rows) const;

    /// Write an array of double, float or std::int64_t (with one column: a
    /// list) whose rows are those of the first rank, then those of the second,
    /// ...; a rank may have none. @p rows are this rank's, row by row.
    template <typename Number>
    void
    write(const std::string         &name,
          const std::vector<Number> &rows,
          unsigned int               n_columns);

    /// Write a short array without columns that all ranks know: no message but
    /// for disk space, now and then.
    void
    write_known(const std::string &name, const std::vector<double> &values);

    /// The text of the first rank as an array of characters.
    void
    write_text(const std::string &name, const std::string &text);

    /// Number of rows and columns of an array of doubles that is all in the file
    /// and not compressed; zero after an error.
    std::pair<std::uint64_t, unsigned int>
    shape(const std::string &name);

    /// Rows [first, first + n_rows) of an array; each rank may ask for others.
    std::vector<double>
    read(const std::string &name, std::uint64_t first, std::uint64_t n_rows);

    std::string
    read_text(const std::string &name);

    /// Compare the array or text with its checksum.
    void
    verify(const std::string &name);

  private:
    /// Rows of this rank within an array.
    struct Rows
    {
      std::uint64_t first; ///< among those of all ranks
      std::uint64_t n;
      std::uint64_t n_on_all_ranks;
      unsigned int  n_columns;
    };

    /// Keep in mind what failed on this rank, unless it did not, until the next
    /// agreement: enough where no rank waits for this one.
    void
    note_error(bool success, const std::string &failure);

    /// Tell all ranks of the first failure. Returns whether there is none.
    bool
    check_on_all_ranks();
    bool
    check_on_all_ranks(bool success, const std::string &failure);

    /// Reserve disk space for this many bytes more.
    void
    reserve(std::uint64_t n_bytes);

    void
    create();
    Hdf5Handle
    create_array(const std::string &name,
                 hid_t              type,
                 std::uint64_t      n_rows,
                 unsigned int       n_columns);
    void
    write_rows(const std::string &name,
               hid_t              memory_type,
               hid_t              file_type,
               const Rows        &rows,
               const void        *values);
    void
    write_by_first_rank(const std::string &name,
                        hid_t              memory_type,
                        hid_t              file_type,
                        hid_t              space,
                        const void        *values);
    void
    write_attribute(const std::string &object,
                    const std::string &name,
                    hid_t              memory_type,
                    hid_t              file_type,
                    const void        *value);
    template <typename Number>
    Number
    read_attribute(const std::string &object,
                   const std::string &name,
                   hid_t              memory_type,
                   hid_t              file_type);
    bool
    is_text(const std::string &name);

    const std::filesystem::path path_;
    const bool                  is_new_;
    const std::filesystem::path part_; ///< its name while it is written
    const MPI_Comm              communicator_;
    const bool                  is_first_rank_;
    const Hdf5Options           options_;
    const Hdf5Errors            errors_;
    Hdf5Handle                  file_;
    std::string                 error_;
    std::string                 own_error_;
    std::uint64_t               n_bytes_    = 0; ///< size of the file, at most
    std::uint64_t               n_reserved_ = 0;
  };
} // namespace talus

#endif
