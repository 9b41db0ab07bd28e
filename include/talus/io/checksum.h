// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_checksum_h
#define talus_io_checksum_h

#include <deal.II/base/mpi.h>

#include <boost/crc.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace talus
{
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

  /// Checksum of a file of which each rank reads a part. Collective.
  std::uint64_t
  checksum_of_file(const std::filesystem::path &path, MPI_Comm communicator);
} // namespace talus

#endif
