// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_errors_h
#define talus_io_hdf5_errors_h

#include <hdf5.h>

#include <string>

namespace talus
{
  /// While such an object lives, the HDF5 library tells it about every failure
  /// instead of printing pages to the terminal; whoever holds it has to look at
  /// the return codes. (Asking the library afterwards is too late: its next
  /// call, were it only to close something, forgets the failure.)
  class Hdf5Errors
  {
  public:
    Hdf5Errors();
    ~Hdf5Errors();

    Hdf5Errors(const Hdf5Errors &) = delete;
    Hdf5Errors &
    operator=(const Hdf5Errors &) = delete;

    /// Why the first call failed that did, as well as the library knows.
    const std::string &
    reason() const
    {
      return reason_;
    }

  private:
    static herr_t
    keep(hid_t stack, void *errors);

    std::string reason_        = "unknown reason";
    bool        is_set_        = false;
    H5E_auto2_t previous_      = nullptr;
    void       *previous_data_ = nullptr;
  };
} // namespace talus

#endif
