// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_disk_space_h
#define talus_io_disk_space_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace talus
{
  /// See that the file @p path, made if it is not there, can grow to
  /// @p n_bytes, without changing its size. Returns why not, empty if it can.
  ///
  /// For libraries that do not survive a full disk. The space is taken from
  /// others where the file system can do that; elsewhere it was there a moment
  /// ago.
  std::string
  reserve_disk_space(const std::filesystem::path &path, std::uint64_t n_bytes);



  /// Give back what the file did not use. Returns why that failed, if it did.
  std::string
  release_disk_space(const std::filesystem::path &path);
} // namespace talus

#endif
