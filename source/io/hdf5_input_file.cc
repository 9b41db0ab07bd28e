// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/checksum.h>
#include <talus/io/hdf5_input_file.h>
#include <talus/io/hdf5_rows.h>

#include <optional>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Handle = Hdf5Handle;

    constexpr unsigned int largest_n_columns = 1 << 24;



    // A file may be damaged or made by another program: size and type of each
    // object are compared with the expectation, and with the size of the file,
    // before memory is allocated or data are read.

    bool
    is_scalar(const hid_t space)
    {
      return H5Sget_simple_extent_type(space) == H5S_SCALAR;
    }



    /// Return the size of an array in bytes; nothing above @p limit. The
    /// library's own product may wrap around.
    std::optional<hsize_t>
    size_in_bytes(const hid_t type, const hid_t space, const hsize_t limit)
    {
      hsize_t   size    = H5Tget_size(type);
      const int n_dims  = H5Sget_simple_extent_ndims(space);
      bool      is_sane = (size > 0 && n_dims >= 0);
      if (!is_sane)
        return {};
      std::vector<hsize_t> extents(n_dims);
      is_sane =
        (n_dims == 0 ||
         H5Sget_simple_extent_dims(space, extents.data(), nullptr) == n_dims);
      for (const hsize_t extent : extents)
        is_sane = is_sane && !__builtin_mul_overflow(size, extent, &size);
      if (!is_sane || size > limit)
        return {};
      return size;
    }



    /// Return whether an attribute is a single number of exactly @p type.
    bool
    is_number(const hid_t attribute, const hid_t type)
    {
      const Hdf5Handle found(H5Aget_type(attribute), H5Tclose);
      const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
      return found.is_valid() && space.is_valid() &&
             H5Tequal(found, type) > 0 && is_scalar(space);
    }



    /// Return the length of the text in an attribute or array; nothing unless
    /// the object is a single text of fixed length. For variable length the
    /// library would give pointers in place of a text.
    std::optional<std::size_t>
    length_of_text(const hid_t type, const hid_t space)
    {
      if (type < 0 || space < 0 || H5Tget_class(type) != H5T_STRING ||
          H5Tis_variable_str(type) != 0 || !is_scalar(space))
        return {};
      return H5Tget_size(type);
    }



    /// Return whether all values of an array are stored in the file
    /// contiguously, neither in chunks nor in external files. A written array
    /// has as many bytes in the file as in memory. An array that was never
    /// written takes no space, and the library would invent the values.
    bool
    is_stored(const hid_t file, const hid_t array)
    {
      const Hdf5Handle type(H5Dget_type(array), H5Tclose);
      const Hdf5Handle space(H5Dget_space(array), H5Sclose);
      const Hdf5Handle properties(H5Dget_create_plist(array), H5Pclose);
      hsize_t          size_of_file = 0;
      if (!type.is_valid() || !space.is_valid() || !properties.is_valid() ||
          H5Fget_filesize(file, &size_of_file) < 0)
        return false;
      const H5D_layout_t layout = H5Pget_layout(properties);
      if ((layout != H5D_CONTIGUOUS && layout != H5D_COMPACT) ||
          H5Pget_external_count(properties) != 0)
        return false;
      const auto size = size_in_bytes(type, space, size_of_file);
      return size.has_value() && *size == H5Dget_storage_size(array);
    }



    /// Open an array; the handle is not valid if there is none.
    Handle
    open_array(const hid_t file, const std::string &name)
    {
      return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
    }



    Handle
    open_attribute(const hid_t        file,
                   const std::string &object,
                   const std::string &name)
    {
      return {H5Aopen_by_name(
                file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose};
    }



    std::string
    is_missing(const std::string &object, const std::string &name)
    {
      return "'" + object + "' has no attribute '" + name + "'";
    }
  } // namespace



  Hdf5InputFile::Hdf5InputFile(const std::filesystem::path &path,
                               const MPI_Comm               communicator)
    : Hdf5File(path, communicator)
  {
    file_ = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access_properties()),
                   H5Fclose);
    check_on_all_ranks(file_.is_valid(), "it could not be opened");
  }



  /// An index by name makes the order independent of the order of writing.
  std::vector<std::string>
  Hdf5InputFile::names(const std::string &group)
  {
    std::vector<std::string> result;
    if (!error().empty())
      return result;
    const auto add = [](hid_t,
                        const char       *name,
                        const H5L_info_t *info,
                        void             *data) -> herr_t {
      static_cast<std::vector<std::string> *>(data)->push_back(name);
      // A link may lead out of the file, or back to a parent group.
      return info->type == H5L_TYPE_HARD ? 0 : -1;
    };
    const Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    const bool   success =
      opened.is_valid() &&
      H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &result) >=
        0;
    check_on_all_ranks(success, "the group '" + group + "' could not be read");
    return result;
  }



  /// Numbers are converted from the file's type to the type in memory, which
  /// has the same values.
  template <typename Number>
  Number
  Hdf5InputFile::read_attribute(const std::string &object,
                                const std::string &name,
                                const hid_t        memory_type,
                                const hid_t        file_type)
  {
    Number value = 0;
    if (!error().empty())
      return value;
    const Handle attribute = open_attribute(file_, object, name);
    check_on_all_ranks(attribute.is_valid() &&
                         is_number(attribute, file_type) &&
                         H5Aread(attribute, memory_type, &value) >= 0,
                       is_missing(object, name));
    return value;
  }



  /// Texts have a fixed length in the file, filled up with zeros.
  std::string
  Hdf5InputFile::text_attribute(const std::string &object,
                                const std::string &name)
  {
    if (!error().empty())
      return "";
    const Handle attribute = open_attribute(file_, object, name);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const auto   length = length_of_text(type, space);
    // The library has already allocated memory of the same length.
    std::string value(length.value_or(0), '\0');
    check_on_all_ranks(length.has_value() &&
                         H5Aread(attribute, type, value.data()) >= 0,
                       is_missing(object, name));
    return value.substr(0, value.find('\0'));
  }



  /// A list has one column.
  std::pair<std::uint64_t, unsigned int>
  Hdf5InputFile::shape(const std::string &name)
  {
    if (!error().empty())
      return {0, 0};
    hsize_t      extent[2] = {0, 1};
    const Handle array     = open_array(file_, name);
    const Handle space(H5Dget_space(array), H5Sclose);
    const Handle type(H5Dget_type(array), H5Tclose);
    const int    rank = H5Sget_simple_extent_ndims(space);
    const bool   success =
      (rank == 1 || rank == 2) && H5Tequal(type, H5T_IEEE_F64LE) > 0 &&
      H5Sget_simple_extent_dims(space, extent, nullptr) == rank &&
      extent[1] > 0 && extent[1] <= largest_n_columns &&
      is_stored(file_, array);
    if (!check_on_all_ranks(success, "it has no array '" + name + "'"))
      return {0, 0};
    return {extent[0], static_cast<unsigned int>(extent[1])};
  }



  std::vector<double>
  Hdf5InputFile::read(const std::string  &name,
                      const std::uint64_t first,
                      const std::uint64_t n_rows)
  {
    const auto [n_there, n_columns] = shape(name);
    if (!error().empty() ||
        !check_on_all_ranks(first <= n_there && n_rows <= n_there - first,
                            text("the array '",
                                 name,
                                 "' has ",
                                 n_there,
                                 " rows, where ",
                                 first + n_rows,
                                 " were expected")))
      return {};
    std::vector<double> rows(n_rows * n_columns);
    const Handle        array   = open_array(file_, name);
    const bool          success = array.is_valid() && transfer_rows(H5Dread,
                                                           array,
                                                           H5T_NATIVE_DOUBLE,
                                                           first,
                                                           n_rows,
                                                           n_columns,
                                                           rows.data());
    check_on_all_ranks(success, "the array '" + name + "' could not be read");
    return rows;
  }



  std::string
  Hdf5InputFile::read_text(const std::string &name)
  {
    if (!error().empty())
      return "";
    const Handle array = open_array(file_, name);
    const Handle type(H5Dget_type(array), H5Tclose);
    const Handle space(H5Dget_space(array), H5Sclose);
    const auto   length   = length_of_text(type, space);
    const bool   is_there = length.has_value() && is_stored(file_, array);
    std::string  text(is_there ? *length : 0, '\0');
    const bool   success =
      is_there &&
      H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0;
    check_on_all_ranks(success, "it has no text '" + name + "'");
    return text.substr(0, text.find('\0'));
  }



  /// Return whether an object is a text: the kind decides how the checksum is
  /// computed.
  bool
  Hdf5InputFile::is_text(const std::string &name)
  {
    if (!error().empty())
      return false;
    const Handle array = open_array(file_, name);
    const Handle type(H5Dget_type(array), H5Tclose);
    const auto   kind = H5Tget_class(type);
    check_on_all_ranks(kind == H5T_STRING || kind == H5T_FLOAT,
                       "'" + name + "' is neither an array nor a text");
    return kind == H5T_STRING;
  }



  /// Each rank reads an equal number of rows, regardless of the writing ranks:
  /// checking a large file takes the time of a single reading.
  void
  Hdf5InputFile::verify(const std::string &name)
  {
    std::uint64_t found = 0;
    if (is_text(name))
      found = checksum(read_text(name));
    else
      {
        const auto [n_rows, n_columns] = shape(name);
        const auto [first, n_own]      = share_of_rank(n_rows);
        const std::uint64_t own =
          checksum(read(name, first, n_own), first * n_columns);
        found = Utilities::MPI::sum(own, communicator());
      }
    const std::uint64_t expected = integer_attribute(name, "checksum");
    if (found != expected)
      note_error("the checksum of '" + name + "' does not match its content");
    check_on_all_ranks();
  }



  template double
  Hdf5InputFile::read_attribute(const std::string &,
                                const std::string &,
                                hid_t,
                                hid_t);
  template std::uint64_t
  Hdf5InputFile::read_attribute(const std::string &,
                                const std::string &,
                                hid_t,
                                hid_t);
} // namespace talus
