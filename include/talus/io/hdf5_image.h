// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_image_h
#define talus_io_hdf5_image_h

#include <hdf5.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// HDF5 file in the memory of this rank. The HDF5 library does not survive a
  /// full disk; therefore it never sees a file on a disk.
  ///
  /// (deal.II's own classes check the return codes of the library only in
  /// Debug.)
  class Hdf5Image
  {
  public:
    /// Make an empty file.
    Hdf5Image();

    /// Read a file with the content @p bytes. @p path is for messages.
    Hdf5Image(const std::string &bytes, const std::filesystem::path &path);

    ~Hdf5Image();
    Hdf5Image(const Hdf5Image &) = delete;
    Hdf5Image &
    operator=(const Hdf5Image &) = delete;

    /// Content of the file. There are no dates: the same data give the same
    /// bytes.
    std::string
    bytes() const;

    /// Write an array of doubles with @p n_columns columns; "a/b" is array "b"
    /// in group "a", made if missing.
    void
    write(const std::string         &name,
          const std::vector<double> &rows,
          unsigned int               n_columns = 1);

    void
    write_text(const std::string &name, const std::string &text);

    /// Read all rows of an array. Throws ExcUser if there is no array of this
    /// name with @p n_columns columns; likewise for the other functions.
    std::vector<double>
    read(const std::string &name, unsigned int n_columns = 1) const;

    double
    read_number(const std::string &name) const
    {
      return read(name).at(0);
    }

    std::string
    read_text(const std::string &name) const;

  private:
    void
    write_array(const std::string          &name,
                hid_t                       type,
                const std::vector<hsize_t> &extents,
                const void                 *values);
    void
    check(bool is_there, const std::string &name) const;

    std::filesystem::path path_;
    hid_t                 file_;
  };
} // namespace talus

#endif
