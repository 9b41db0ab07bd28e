// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_checksum_h
#define talus_io_checksum_h

#include <boost/crc.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Bijection of 64-bit numbers: every bit of the result depends on every bit
  /// of the argument (the finaliser of splitmix64).
  inline std::uint64_t
  mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }



  /// Checksum of an array whose values have the numbers @p first, @p first + 1,
  /// ... in a larger array. The checksums of the parts, added modulo 2^64, are
  /// the checksum of the whole, so each rank can sum any part. A single changed
  /// value always changes the sum, because mix() is a bijection.
  inline std::uint64_t
  checksum(const std::vector<double> &values, const std::uint64_t first)
  {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      {
        std::uint64_t bits;
        std::memcpy(&bits, &values[i], sizeof(bits));
        sum += mix(bits ^ mix(first + i));
      }
    return sum;
  }



  /// CRC-32 of a text.
  inline std::uint64_t
  checksum(const std::string &text)
  {
    boost::crc_32_type crc;
    crc.process_bytes(text.data(), text.size());
    return crc.checksum();
  }



  /// CRC-32 of a file: equals the checksum of the content as a text.
  std::uint64_t
  checksum_of_file(const std::filesystem::path &path);
} // namespace talus

#endif
