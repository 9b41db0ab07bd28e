// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_errors_h
#define talus_io_hdf5_errors_h

#include <hdf5.h>

#include <string>

namespace talus
{
  /// Catch failures of the HDF5 library for the lifetime of this object, in
  /// place of pages on the terminal. Callers must check the return codes.
  /// (Asking the library afterwards is too late: the next call, even to close
  /// an object, forgets the failure.)
  class Hdf5Errors
  {
  public:
    Hdf5Errors();
    ~Hdf5Errors();

    Hdf5Errors(const Hdf5Errors &) = delete;
    Hdf5Errors &
    operator=(const Hdf5Errors &) = delete;

    /// Return the library's reason for the first failure.
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
