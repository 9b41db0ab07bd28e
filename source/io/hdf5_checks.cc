// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/hdf5_checks.h>
#include <talus/io/hdf5_handle.h>

#include <vector>

namespace talus
{
  namespace
  {
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
  } // namespace



  bool
  is_number(const hid_t attribute, const hid_t type)
  {
    const Hdf5Handle found(H5Aget_type(attribute), H5Tclose);
    const Hdf5Handle space(H5Aget_space(attribute), H5Sclose);
    return found.is_valid() && space.is_valid() && H5Tequal(found, type) > 0 &&
           is_scalar(space);
  }



  /// For variable length the library would give pointers in place of a text.
  std::optional<std::size_t>
  length_of_text(const hid_t type, const hid_t space)
  {
    if (type < 0 || space < 0 || H5Tget_class(type) != H5T_STRING ||
        H5Tis_variable_str(type) != 0 || !is_scalar(space))
      return {};
    return H5Tget_size(type);
  }



  /// A written array has as many bytes in the file as in memory. An array that
  /// was never written takes no space, and the library would invent the values.
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
} // namespace talus
