// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_checks_h
#define talus_io_hdf5_checks_h

#include <hdf5.h>

#include <cstddef>
#include <optional>

namespace talus
{
  // A file may be damaged or made by another program: size and type of each
  // object are compared with the expectation, and with the size of the file,
  // before memory is allocated or data are read.

  /// Return whether an attribute is a single number of exactly @p type.
  bool
  is_number(hid_t attribute, hid_t type);

  /// Return the length of the text in an attribute or array; nothing unless the
  /// object is a single text.
  std::optional<std::size_t>
  length_of_text(hid_t type, hid_t space);

  /// Return whether all values of an array are stored in the file contiguously,
  /// neither in chunks nor in external files.
  bool
  is_stored(hid_t file, hid_t array);
} // namespace talus

#endif
