#include <talus/base/errors.h>
#include <talus/observers/vtu_arrays.h>

#include <zlib.h>

#include <array>
#include <cstdint>
#include <limits>

namespace talus
{
  using namespace dealii;

  // deal.II's takes as long as the compression.
  std::string
  base64(const unsigned char *bytes, const std::size_t n)
  {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                              "abcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string    text((n + 2) / 3 * 4, '=');
    char          *to = text.data();
    for (std::size_t i = 0; i < n; i += 3, to += 4)
      {
        const unsigned int n_here = (n - i < 3 ? n - i : 3);
        std::uint32_t      bits   = bytes[i] << 16;
        if (n_here > 1)
          bits |= bytes[i + 1] << 8;
        if (n_here > 2)
          bits |= bytes[i + 2];
        for (unsigned int digit = 0; digit <= n_here; ++digit)
          to[digit] = digits[(bits >> (18 - 6 * digit)) & 63];
      }
    return text;
  }



  template <typename Number>
  std::string
  vtu_array(const std::vector<Number> &values)
  {
    const std::size_t size = values.size() * sizeof(Number);
    AssertThrow(size <= std::numeric_limits<std::uint32_t>::max(),
                ExcMessage("An array of a VTU file is larger than 4 GB. Use "
                           "more ranks or 'Output/Format = hdf5'."));
    uLongf                     packed_size = compressBound(size);
    std::vector<unsigned char> packed(packed_size);
    const int                  error =
      compress2(packed.data(),
                &packed_size,
                reinterpret_cast<const unsigned char *>(values.data()),
                size,
                Z_BEST_SPEED);
    AssertThrow(error == Z_OK, ExcInternalError());

    const std::array<std::uint32_t, 4> header = {
      {1,
       static_cast<std::uint32_t>(size),
       static_cast<std::uint32_t>(size),
       static_cast<std::uint32_t>(packed_size)}};
    return base64(reinterpret_cast<const unsigned char *>(header.data()),
                  sizeof(header)) +
           base64(packed.data(), packed_size);
  }



  template std::string
  vtu_array(const std::vector<float> &);
  template std::string
  vtu_array(const std::vector<std::int32_t> &);
  template std::string
  vtu_array(const std::vector<std::uint8_t> &);
} // namespace talus
