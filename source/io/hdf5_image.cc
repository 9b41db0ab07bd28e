// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/hdf5_image.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Object of the HDF5 library, closed at the end of its scope.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*const close)(hid_t))
        : id_(id)
        , close_(close)
      {}

      Handle(const Handle &) = delete;
      Handle &
      operator=(const Handle &) = delete;

      ~Handle()
      {
        close_(id_);
      }

      operator hid_t() const
      {
        return id_;
      }

    private:
      const hid_t id_;
      herr_t (*const close_)(hid_t);
    };



    /// Open a file in memory; empty @p bytes make a new file. The library's
    /// pages of errors on the terminal are switched off.
    hid_t
    open_image(const std::string &bytes, const Hdf5Image *owner)
    {
      // Files of one name would be one file for the library, which also refuses
      // a name under which there is a file on the disk.
      const std::string name = text("/dev/null/", owner);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_fapl_core(access, 1 << 20, /*backing_store=*/false);
      if (bytes.empty())
        return H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
      H5Pset_file_image(access, const_cast<char *>(bytes.data()), bytes.size());
      return H5Fopen(name.c_str(), H5F_ACC_RDONLY, access);
    }
  } // namespace



  Hdf5Image::Hdf5Image()
    : file_(open_image("", this))
  {}



  Hdf5Image::Hdf5Image(const std::string           &bytes,
                       const std::filesystem::path &path)
    : path_(path)
    , file_(open_image(bytes, this))
  {}



  Hdf5Image::~Hdf5Image()
  {
    H5Fclose(file_);
  }



  std::string
  Hdf5Image::bytes() const
  {
    H5Fflush(file_, H5F_SCOPE_LOCAL);
    std::string bytes(H5Fget_file_image(file_, nullptr, 0), '\0');
    H5Fget_file_image(file_, bytes.data(), bytes.size());
    return bytes;
  }



  void
  Hdf5Image::write_array(const std::string          &name,
                         const hid_t                 type,
                         const std::vector<hsize_t> &extents,
                         const void                 *values)
  {
    const Handle space(
      H5Screate_simple(extents.size(), extents.data(), nullptr), H5Sclose);
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(links, 1);
    const Handle undated(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(undated, false);
    const Handle array(
      H5Dcreate2(file_, name.c_str(), type, space, links, undated, H5P_DEFAULT),
      H5Dclose);
    AssertThrow(H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >=
                  0,
                ExcInternalError(name));
  }



  /// An array with one column is stored as one-dimensional.
  void
  Hdf5Image::write(const std::string         &name,
                   const std::vector<double> &rows,
                   const unsigned int         n_columns)
  {
    std::vector<hsize_t> extents = {rows.size() / n_columns};
    if (n_columns > 1)
      extents.push_back(n_columns);
    write_array(name, H5T_NATIVE_DOUBLE, extents, rows.data());
  }



  /// A text is an array of no extent; HDF5 has no type of length zero.
  void
  Hdf5Image::write_text(const std::string &name, const std::string &text)
  {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<std::size_t>(text.size(), 1));
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_UTF8);
    write_array(name, type, {}, text.c_str());
  }



  void
  Hdf5Image::check(const bool is_there, const std::string &name) const
  {
    AssertThrow(is_there,
                ExcUser("In '" + path_.string() + "' the entry '" + name +
                        "', which this version of talus needs, is missing or "
                        "has another form. Resume with the version of talus "
                        "that wrote the file, or remove the checkpoint, so "
                        "that the previous one is used."));
  }



  std::vector<double>
  Hdf5Image::read(const std::string &name, const unsigned int n_columns) const
  {
    const Handle array(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle space(H5Dget_space(array), H5Sclose);
    hsize_t      extents[2] = {0, 1};
    const int    rank       = H5Sget_simple_extent_ndims(space);
    check((rank == 1 || rank == 2) &&
            H5Sget_simple_extent_dims(space, extents, nullptr) == rank &&
            extents[1] == n_columns,
          name);
    std::vector<double> rows(extents[0] * n_columns);
    check(H5Dread(array,
                  H5T_NATIVE_DOUBLE,
                  H5S_ALL,
                  H5S_ALL,
                  H5P_DEFAULT,
                  rows.data()) >= 0,
          name);
    return rows;
  }



  /// Texts have a fixed length in the file, filled up with zeros.
  std::string
  Hdf5Image::read_text(const std::string &name) const
  {
    const Handle array(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(array), H5Tclose);
    std::string  text(H5Tget_size(type), '\0');
    check(H5Tget_class(type) == H5T_STRING &&
            H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >=
              0,
          name);
    return text.substr(0, text.find('\0'));
  }
} // namespace talus
