#ifndef talus_io_hdf5_file_h
#define talus_io_hdf5_file_h

#include <talus/io/hdf5_errors.h>

#include <deal.II/base/mpi.h>

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// An HDF5 file that all ranks write or read together. (deal.II's own classes
  /// look at the return codes of the library in Debug only.)
  ///
  /// Like a stream it remembers its first failure, on whichever rank that was:
  /// all ranks then know it, and all further calls do nothing. Whoever writes
  /// looks at error() after close(), whoever reads before using what was read.
  /// All calls are collective.
  ///
  /// Arrays of doubles get an attribute `checksum` (see checksum.h), texts too.
  /// There are no time stamps in the file, and its own metadata have checksums
  /// (HDF5 1.8 or later reads it).
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
             MPI_Comm                     communicator);

    ~Hdf5File();

    Hdf5File(const Hdf5File &) = delete;

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

    /// Bring everything to the disk and close.
    void
    close();

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
                  double             value);
    void
    set_attribute(const std::string &object,
                  const std::string &name,
                  std::uint64_t      value);

    std::string
    text_attribute(const std::string &object, const std::string &name);
    double
    number_attribute(const std::string &object, const std::string &name);
    std::uint64_t
    integer_attribute(const std::string &object, const std::string &name);

    /// Where the rows of this rank, @p n_rows, begin among those of all, and
    /// how many there are on all ranks.
    std::pair<std::uint64_t, std::uint64_t>
    first_and_total(std::uint64_t n_rows) const;

    /// Write an array whose rows are those of the first rank, then those of the
    /// second, ...; a rank may have none. @p rows are this rank's, row by row.
    void
    write(const std::string         &name,
          const std::vector<double> &rows,
          unsigned int               n_columns);

    /// Number of rows and columns of an array; zero after an error.
    std::pair<std::uint64_t, unsigned int>
    shape(const std::string &name);

    /// Rows [first, first + n_rows) of an array; each rank may ask for others.
    std::vector<double>
    read(const std::string &name, std::uint64_t first, std::uint64_t n_rows);

    /// Compare the array or text with its checksum.
    void
    verify(const std::string &name);

    /// Write a short array without columns that all ranks know: no message.
    void
    write_known(const std::string &name, const std::vector<double> &values);

    /// The text of the first rank as an array of characters.
    void
    write_text(const std::string &name, const std::string &text);

    std::string
    read_text(const std::string &name);

  private:
    /// Keep in mind what failed, unless it did not, until the next agreement:
    /// enough where no rank waits for this one.
    void
    remember(bool success, const std::string &failure);
    /// The same, and agree with the other ranks on whether all is well.
    bool
    conclude(bool success, const std::string &failure);
    /// Make an array that only the first rank fills.
    void
    write_by_first_rank(const std::string &name,
                        hid_t              file_type,
                        hid_t              type,
                        hid_t              space,
                        const void        *values);
    void
    write_attribute(const std::string &object,
                    const std::string &name,
                    hid_t              type,
                    const void        *value);
    void
    read_attribute(const std::string &object,
                   const std::string &name,
                   hid_t              type,
                   void              *value);
    bool
    is_text(const std::string &name);
    void
    compare(const std::string &name, std::uint64_t found);

    std::filesystem::path path_;
    MPI_Comm              communicator_;
    const Hdf5Errors      errors_;
    hid_t                 file_ = -1;
    std::string           error_;
    std::string           own_complaint_;
  };
} // namespace talus

#endif
