#ifndef talus_observers_hdf5_handle_h
#define talus_observers_hdf5_handle_h

#include <hdf5.h>

#include <algorithm>
#include <string>

namespace talus
{
  /// An open object of the HDF5 library, closed at the end of its scope.
  class Hdf5Handle
  {
  public:
    Hdf5Handle(const hid_t id, herr_t (*close)(hid_t))
      : id_(id)
      , close_(close)
    {}

    ~Hdf5Handle()
    {
      if (id_ >= 0)
        close_(id_);
    }

    Hdf5Handle(const Hdf5Handle &) = delete;

    operator hid_t() const
    {
      return id_;
    }

  private:
    hid_t id_;
    herr_t (*close_)(hid_t);
  };



  /// The type of a text of this length, which is fixed in the file.
  inline Hdf5Handle
  text_type(const std::string &text)
  {
    const hid_t id = H5Tcopy(H5T_C_S1);
    H5Tset_size(id, std::max<std::size_t>(text.size(), 1));
    H5Tset_strpad(id, H5T_STR_NULLPAD);
    H5Tset_cset(id, H5T_CSET_UTF8);
    return {id, H5Tclose};
  }



  /// Nothing after a success; after a failure the library's own words from deep
  /// inside, which the next call of the library forgets.
  inline std::string
  hdf5_complaint(const bool success)
  {
    if (success)
      return "";
    std::string description;
    const auto  keep_first =
      [](unsigned int, const H5E_error2_t *entry, void *data) -> herr_t {
      auto &kept = *static_cast<std::string *>(data);
      if (kept.empty() && entry->desc != nullptr)
        kept = entry->desc;
      return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &description);
    return description.empty() ? "no reason given" : description;
  }
} // namespace talus

#endif
