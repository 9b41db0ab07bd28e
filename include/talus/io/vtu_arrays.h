// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_vtu_arrays_h
#define talus_io_vtu_arrays_h

#include <cstddef>
#include <ostream>
#include <vector>

namespace talus
{
  /// Write @p n bytes as base64 (RFC 4648), padded with '='.
  void
  write_base64(std::ostream &out, const unsigned char *bytes, std::size_t n);



  /// Write the content of a DataArray of VTK's XML files with format="binary"
  /// and compressor="vtkZLibDataCompressor": base64 of the four numbers 1,
  /// size, size and compressed size [bytes], followed by base64 of the
  /// compressed values.
  template <typename Number>
  void
  write_vtu_array(std::ostream &out, const std::vector<Number> &values);
} // namespace talus

#endif
