// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/vtu_arrays.h>

#include <zlib.h>

#include <array>
#include <cstdint>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Bytes = std::vector<unsigned char>;

    /// Compress bytes with zlib at @p level; level 0 only wraps.
    Bytes
    pack(const unsigned char *bytes, const std::size_t n, const int level)
    {
      uLongf    size = compressBound(n);
      Bytes     packed(size);
      const int error = compress2(packed.data(), &size, bytes, n, level);
      AssertThrow(error == Z_OK, ExcInternalError());
      packed.resize(size);
      return packed;
    }



    /// Return the level for zlib. Most computed numbers look like noise to
    /// zlib: compression would take most of the time of an output and save a
    /// tenth. Noise is only wrapped. A sample from the middle of the array
    /// decides.
    int
    level_for(const unsigned char *bytes, const std::size_t n)
    {
      constexpr std::size_t n_sample = 4096;
      if (n < 2 * n_sample)
        return Z_BEST_SPEED;
      const Bytes sample = pack(bytes + n / 2, n_sample, Z_BEST_SPEED);
      return sample.size() <= n_sample / 2 ? Z_BEST_SPEED : Z_NO_COMPRESSION;
    }
  } // namespace



  // Own conversion: deal.II's takes as long as the compression, and makes
  // copies. Three bytes become four digits; the last group is filled up with
  // '='. Digits go through a buffer, since a call of the stream per digit would
  // take longer than the conversion.
  void
  write_base64(std::ostream        &out,
               const unsigned char *bytes,
               const std::size_t    n)
  {
    constexpr char          digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "abcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<char, 16384> buffer; // a multiple of 4
    std::size_t             size = 0;
    for (std::size_t i = 0; i < n; i += 3)
      {
        const unsigned int n_here = (n - i < 3 ? n - i : 3);
        std::uint32_t      bits   = bytes[i] << 16;
        if (n_here > 1)
          bits |= bytes[i + 1] << 8;
        if (n_here > 2)
          bits |= bytes[i + 2];
        for (unsigned int digit = 0; digit < 4; ++digit)
          buffer[size++] =
            (digit <= n_here ? digits[(bits >> (18 - 6 * digit)) & 63] : '=');
        if (size == buffer.size())
          {
            out.write(buffer.data(), size);
            size = 0;
          }
      }
    out.write(buffer.data(), size);
  }



  /// VTK's format "binary" with a compressor: a header of four 32-bit numbers
  /// (blocks, size of a block, size of the last block, compressed size), then
  /// the data, header and data each in base64. A single block needs no list of
  /// sizes.
  template <typename Number>
  void
  write_vtu_array(std::ostream &out, const std::vector<Number> &values)
  {
    const std::size_t size = values.size() * sizeof(Number);
    AssertThrow(size <= std::numeric_limits<std::uint32_t>::max(),
                ExcUser("An array of a VTU file is larger than 4 GB. Use "
                        "more ranks."));
    const auto *bytes  = reinterpret_cast<const unsigned char *>(values.data());
    const Bytes packed = pack(bytes, size, level_for(bytes, size));

    const std::array<std::uint32_t, 4> header = {
      {1,
       static_cast<std::uint32_t>(size),
       static_cast<std::uint32_t>(size),
       static_cast<std::uint32_t>(packed.size())}};
    write_base64(out,
                 reinterpret_cast<const unsigned char *>(header.data()),
                 sizeof(header));
    write_base64(out, packed.data(), packed.size());
  }



  template decltype(write_vtu_array<double>) write_vtu_array<double>;
  template decltype(write_vtu_array<float>)  write_vtu_array<float>;
  template decltype(write_vtu_array<std::int32_t>)
    write_vtu_array<std::int32_t>;
  template decltype(write_vtu_array<std::uint8_t>)
    write_vtu_array<std::uint8_t>;
} // namespace talus
