// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/disk_space.h>

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace talus
{
  /// fallocate() with FALLOC_FL_KEEP_SIZE takes the blocks from the file system
  /// and leaves the size as it is, so that the library finds the file as it
  /// expects it. posix_fallocate() would change the size and, where the file
  /// system cannot reserve, write to each block of the file. Where it cannot,
  /// all that can be asked is how much is free now.
  std::string
  reserve_disk_space(const std::filesystem::path &path,
                     const std::uint64_t          n_bytes)
  {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT, 0666);
    if (file < 0)
      return std::strerror(errno);
    int error = 0;
    do
      error =
        (::fallocate(file, FALLOC_FL_KEEP_SIZE, 0, n_bytes) == 0 ? 0 : errno);
    // A signal, as that by which a run is stopped, interrupts it.
    while (error == EINTR);
    ::close(file);

    if (error == EOPNOTSUPP || error == ENOSYS)
      {
        // What the file has already need not be free.
        std::error_code     ignored;
        const std::uint64_t size  = std::filesystem::file_size(path, ignored);
        const auto          space = std::filesystem::space(path, ignored);
        error = (ignored || size + space.available >= n_bytes ? 0 : ENOSPC);
      }
    return error == 0 ? "" : std::strerror(error);
  }



  /// Setting a file to the size that it has frees the blocks beyond its end.
  std::string
  release_disk_space(const std::filesystem::path &path)
  {
    std::error_code     error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (!error)
      std::filesystem::resize_file(path, size, error);
    return error ? error.message() : "";
  }
} // namespace talus
