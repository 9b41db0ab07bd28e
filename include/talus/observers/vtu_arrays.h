#ifndef talus_observers_vtu_arrays_h
#define talus_observers_vtu_arrays_h

#include <cstddef>
#include <string>
#include <vector>

namespace talus
{
  /// Base64 (RFC 4648) of @p n bytes, padded with '='.
  std::string
  base64(const unsigned char *bytes, std::size_t n);



  /// The content of a DataArray of VTK's XML files with format="binary" and
  /// compressor="vtkZLibDataCompressor": base64 of the four numbers 1, size,
  /// size and compressed size [bytes], then base64 of the compressed values.
  template <typename Number>
  std::string
  vtu_array(const std::vector<Number> &values);
} // namespace talus

#endif
