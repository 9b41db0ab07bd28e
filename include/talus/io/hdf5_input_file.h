// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_input_file_h
#define talus_io_hdf5_input_file_h

#include <talus/io/hdf5_file.h>

#include <vector>

namespace talus
{
  /// HDF5 file that all ranks read together.
  ///
  /// A file may be damaged or made by another program: size and type of each
  /// object are compared with the expectation before data are read.
  class Hdf5InputFile : public Hdf5File
  {
  public:
    Hdf5InputFile(const std::filesystem::path &path, MPI_Comm communicator);

    /// Return the names of the objects in a group, sorted.
    std::vector<std::string>
    names(const std::string &group);

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

    /// Return the number of rows and columns of an array of doubles, stored
    /// completely and without compression; zero after an error.
    std::pair<std::uint64_t, unsigned int>
    shape(const std::string &name);

    /// Read rows [first, first + n_rows) of an array; ranges may differ by
    /// rank.
    std::vector<double>
    read(const std::string &name, std::uint64_t first, std::uint64_t n_rows);

    std::string
    read_text(const std::string &name);

    /// Compare the array or text with the stored checksum.
    void
    verify(const std::string &name);

  private:
    template <typename Number>
    Number
    read_attribute(const std::string &object,
                   const std::string &name,
                   hid_t              memory_type,
                   hid_t              file_type);
    bool
    is_text(const std::string &name);
  };
} // namespace talus

#endif
