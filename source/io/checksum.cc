// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/checksum.h>

#include <fstream>

namespace talus
{
  // Read in blocks of a megabyte: a mesh file may exceed the memory.
  std::uint64_t
  checksum_of_file(const std::filesystem::path &path)
  {
    std::ifstream      file(path, std::ios::binary);
    std::vector<char>  block(1 << 20);
    boost::crc_32_type crc;
    do
      {
        file.read(block.data(), block.size());
        crc.process_bytes(block.data(), file.gcount());
    } while (file);
    return crc.checksum();
  }
} // namespace talus
