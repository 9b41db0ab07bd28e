// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_output_file_h
#define talus_io_hdf5_output_file_h

#include <talus/io/hdf5_file.h>

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



  /// A new HDF5 file, over an older one of its name, that all ranks write
  /// together.
  ///
  /// The HDF5 library does not survive a full disk: with one rank it crashes at
  /// the end of the program, with several it waits for ever. Therefore the
  /// space for each array is reserved before it is written, as if it could not
  /// be compressed.
  ///
  /// There are no dates in the file: the same data on the same number of ranks
  /// give the same bytes. Its own metadata have checksums (HDF5 1.8 or later
  /// reads it).
  class Hdf5OutputFile : public Hdf5File
  {
  public:
    Hdf5OutputFile(const std::filesystem::path &path,
                   MPI_Comm                     communicator,
                   const Hdf5Options           &options = {});

    /// A file that was not closed is not complete.
    ~Hdf5OutputFile();

    /// Complete the file, bring it to the disk and give it its name.
    void
    close();

    /// Make a group; "a/b" needs group "a".
    void
    create_group(const std::string &name);

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

  private:
    /// Rows of this rank within an array.
    struct Rows
    {
      std::uint64_t first; ///< among those of all ranks
      std::uint64_t n;
      std::uint64_t n_on_all_ranks;
      unsigned int  n_columns;
    };

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
    const std::filesystem::path part_; ///< its name while it is written
    const bool                  is_first_rank_;
    const Hdf5Options           options_;
    std::uint64_t               n_bytes_    = 0; ///< size of the file, at most
    std::uint64_t               n_reserved_ = 0;
  };
} // namespace talus

#endif
