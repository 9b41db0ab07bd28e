// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/checksum.h>

#include <fstream>
#include <vector>

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



  namespace
  {
    /// Bijection of 64-bit numbers: every bit of the result depends on every
    /// bit of the argument (the finaliser of splitmix64).
    std::uint64_t
    mix(std::uint64_t z)
    {
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      return z ^ (z >> 31);
    }
  } // namespace



  /// The sum over the blocks of a megabyte is independent of the number of
  /// ranks. A single changed block always changes the sum, because mix() is a
  /// bijection.
  std::uint64_t
  checksum_of_file(const std::filesystem::path &path,
                   const MPI_Comm               communicator)
  {
    const std::uint64_t n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(communicator);
    std::ifstream file(path, std::ios::binary);
    std::string   block(1 << 20, ' ');
    std::uint64_t sum = 0;
    for (std::uint64_t b =
           dealii::Utilities::MPI::this_mpi_process(communicator);
         file.seekg(b << 20).read(block.data(), block.size()),
                       file.gcount() > 0;
         b += n_ranks)
      sum += mix(checksum(block.substr(0, file.gcount())) ^ mix(b));
    return dealii::Utilities::MPI::sum(sum, communicator);
  }
} // namespace talus
