// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/hdf5_errors.h>

namespace talus
{
  namespace
  {
    /// Return the text in the last pair of quotes; without quotes the whole
    /// text.
    std::string
    last_quoted(const std::string &text)
    {
      const auto end = text.rfind('\'');
      if (end == std::string::npos || end == 0)
        return text;
      const auto begin = text.rfind('\'', end - 1);
      return begin == std::string::npos
               ? text
               : text.substr(begin + 1, end - begin - 1);
    }
  } // namespace



  /// By default HDF5 prints a stack of errors to the terminal. Here the reason
  /// is kept for an error message of talus, and the destructor restores the
  /// previous setting.
  Hdf5Errors::Hdf5Errors()
  {
    H5Eget_auto2(H5E_DEFAULT, &previous_, &previous_data_);
    H5Eset_auto2(H5E_DEFAULT, &Hdf5Errors::keep, this);
  }



  Hdf5Errors::~Hdf5Errors()
  {
    H5Eset_auto2(H5E_DEFAULT, previous_, previous_data_);
  }



  herr_t
  Hdf5Errors::keep(const hid_t stack, void *const data)
  {
    auto &errors = *static_cast<Hdf5Errors *>(data);
    if (errors.is_set_)
      return 0;
    // The first entry is the innermost function, where the message of the
    // operating system or of MPI stands in quotes.
    const auto keep_first =
      [](const unsigned int n, const H5E_error2_t *entry, void *reason) {
        if (n == 0 && entry->desc != nullptr)
          *static_cast<std::string *>(reason) = last_quoted(entry->desc);
        return herr_t(0);
      };
    errors.is_set_ = true;
    return H5Ewalk2(stack, H5E_WALK_UPWARD, keep_first, &errors.reason_);
  }
} // namespace talus
