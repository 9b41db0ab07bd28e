// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_checks_h
#define talus_io_hdf5_checks_h

#include <hdf5.h>

#include <cstddef>
#include <optional>

namespace talus
{
  // A file may have been damaged or made by others: what it claims to hold is
  // compared with what is expected, and with its size, before memory is taken or
  // anything is read.

  /// Whether an attribute is one number of exactly this type.
  bool
  is_number(hid_t attribute, hid_t type);

  /// Length of the one text that an attribute or an array is; nothing if it is
  /// something else.
  std::optional<std::size_t>
  length_of_text(hid_t type, hid_t space);

  /// Whether all values that an array claims to have are in the file, in one
  /// piece, and not in chunks, elsewhere or nowhere.
  bool
  is_stored(hid_t file, hid_t array);
} // namespace talus

#endif
