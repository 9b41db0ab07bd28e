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
  /// A bijection of 64-bit numbers in which every bit of the result depends on
  /// every bit of the argument (the finaliser of splitmix64).
  inline std::uint64_t
  mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }



  /// Checksum of the values @p first, @p first + 1, ... of an array. Those of
  /// the parts of an array, added modulo 2^64, are that of the whole, so every
  /// rank can do its part, whatever the parts are. One changed value always
  /// shows: mix() is a bijection.
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



  /// CRC-32 of a file, the same as that of its content as a text.
  std::uint64_t
  checksum_of_file(const std::filesystem::path &path);
} // namespace talus

#endif
