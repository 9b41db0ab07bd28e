// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_handle_h
#define talus_io_hdf5_handle_h

#include <hdf5.h>

#include <algorithm>
#include <string>
#include <utility>

namespace talus
{
  /// Object of the HDF5 library, closed at the end of its scope. Most functions
  /// of the library return a negative number on failure.
  class Hdf5Handle
  {
  public:
    using Close = herr_t (*)(hid_t);

    Hdf5Handle() = default;

    Hdf5Handle(const hid_t id, const Close close)
      : id_(id)
      , close_(close)
    {}

    Hdf5Handle(Hdf5Handle &&other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID))
      , close_(other.close_)
    {}

    Hdf5Handle &
    operator=(Hdf5Handle &&other) noexcept
    {
      std::swap(id_, other.id_);
      std::swap(close_, other.close_);
      return *this;
    }

    ~Hdf5Handle()
    {
      close();
    }

    /// Return whether there is an object.
    bool
    is_valid() const
    {
      return id_ >= 0;
    }

    /// Close the object now; false without object and on failure.
    bool
    close()
    {
      const hid_t id = std::exchange(id_, H5I_INVALID_HID);
      return id >= 0 && close_(id) >= 0;
    }

    operator hid_t() const
    {
      return id_;
    }

  private:
    hid_t id_    = H5I_INVALID_HID;
    Close close_ = nullptr;
  };



  /// Properties of a new file, group or dataset without dates.
  inline Hdf5Handle
  undated(const hid_t kind)
  {
    Hdf5Handle properties(H5Pcreate(kind), H5Pclose);
    if (!properties.is_valid() || H5Pset_obj_track_times(properties, false) < 0)
      return {};
    return properties;
  }



  /// Return the type of a text as long as @p text; HDF5 has no type of length
  /// zero.
  inline Hdf5Handle
  text_type(const std::string &text)
  {
    const hid_t id = H5Tcopy(H5T_C_S1);
    H5Tset_size(id, std::max<std::size_t>(text.size(), 1));
    H5Tset_strpad(id, H5T_STR_NULLPAD);
    H5Tset_cset(id, H5T_CSET_UTF8);
    return {id, H5Tclose};
  }
} // namespace talus

#endif
