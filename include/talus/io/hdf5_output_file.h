// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_output_file_h
#define talus_io_hdf5_output_file_h

#include <talus/io/hdf5_file.h>

#include <vector>

namespace talus
{
  /// Properties of a new HDF5 file.
  struct Hdf5Options
  {
    /// Arrays of doubles and texts get an attribute `checksum`; see checksum.h.
    bool has_checksums = true;
    /// Arrays are compressed.
    bool is_compressed = false;
    /// The file gets the final name only in close(), when the whole content is
    /// on the disk. On failure before, an older file of the same name survives,
    /// and nothing else is left.
    bool is_atomic = false;
  };



  /// New HDF5 file that all ranks write together, replacing an older file of
  /// the same name.
  ///
  /// The HDF5 library does not survive a full disk: with one rank the library
  /// crashes at the end of the program, with several ranks it waits for ever.
  /// Therefore disk space for each array is reserved before writing, as if the
  /// data could not be compressed.
  ///
  /// There are no dates in the file: the same data on the same number of ranks
  /// give the same bytes. The library's metadata have checksums (readable with
  /// HDF5 1.8 or later).
  class Hdf5OutputFile : public Hdf5File
  {
  public:
    Hdf5OutputFile(const std::filesystem::path &path,
                   MPI_Comm                     communicator,
                   const Hdf5Options           &options = {});

    /// Remove an atomic file that was not closed; any further file without
    /// close() is incomplete.
    ~Hdf5OutputFile();

    /// Complete the file, bring it to the disk and rename it to the final name.
    void
    close();

    /// Make a group; "a/b" needs group "a".
    void
    create_group(const std::string &name);

    /// Set an attribute of the group or array @p object; "/" is the file.
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

    /// Write an array of double, float or std::int64_t; an array with one
    /// column is a list. The rows of the first rank come first, followed by the
    /// second rank, and further; a rank may have none. @p rows are the rows of
    /// this rank.
    template <typename Number>
    void
    write(const std::string         &name,
          const std::vector<Number> &rows,
          unsigned int               n_columns);

    /// Write the text of the first rank as an array of characters.
    void
    write_text(const std::string &name, const std::string &text);

  private:
    /// Rows of this rank within an array.
    struct Rows
    {
      std::uint64_t first; ///< among the rows of all ranks
      std::uint64_t n;
      std::uint64_t n_on_all_ranks;
      unsigned int  n_columns;
    };

    /// Reserve disk space for @p n_bytes more.
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
                                write_attribute(const std::string &object,
                                                const std::string &name,
                                                hid_t              memory_type,
                                                hid_t              file_type,
                                                const void        *value);
    const std::filesystem::path part_; ///< name during writing
    const bool                  is_first_rank_;
    const Hdf5Options           options_;
    std::uint64_t               n_bytes_    = 0; ///< size of the file, at most
    std::uint64_t               n_reserved_ = 0;
  };
} // namespace talus

#endif
