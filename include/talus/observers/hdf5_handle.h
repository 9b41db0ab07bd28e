#ifndef talus_observers_hdf5_handle_h
#define talus_observers_hdf5_handle_h

#include <hdf5.h>

#include <utility>

namespace talus
{
  /// An object of the HDF5 library, closed when it goes out of scope. Most
  /// functions of the library return a negative number if they fail.
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

    /// Whether there is an object.
    bool
    well() const
    {
      return id_ >= 0;
    }

    /// Close it now; false if there is none, or if that fails.
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
} // namespace talus

#endif
