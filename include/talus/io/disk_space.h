// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_disk_space_h
#define talus_io_disk_space_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace talus
{
  /// Check whether the file @p path can grow to @p n_bytes, and make the file
  /// if there is none; its size stays. Returns the reason for a failure, or an
  /// empty text.
  ///
  /// For libraries that do not survive a full disk. The space is reserved where
  /// the file system can reserve; elsewhere only the free space is compared,
  /// and another program may still use it.
  std::string
  reserve_disk_space(const std::filesystem::path &path, std::uint64_t n_bytes);



  /// Release reserved space behind the end of the file. Returns the reason for
  /// a failure, or an empty text.
  std::string
  release_disk_space(const std::filesystem::path &path);
} // namespace talus

#endif
