// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/disk_space.h>

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace talus
{
  /// fallocate() with FALLOC_FL_KEEP_SIZE reserves the blocks and keeps the
  /// size of the file as the library expects it. posix_fallocate() would change
  /// the size and, on file systems without reservation, write to each block.
  /// Without reservation only the free space can be asked for.
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
    // A signal, for instance to stop the run, interrupts fallocate().
    while (error == EINTR);
    ::close(file);

    if (error == EOPNOTSUPP || error == ENOSYS)
      {
        // Bytes already in the file need no free space.
        std::error_code     ignored;
        const std::uint64_t size  = std::filesystem::file_size(path, ignored);
        const auto          space = std::filesystem::space(path, ignored);
        error = (ignored || size + space.available >= n_bytes ? 0 : ENOSPC);
      }
    return error == 0 ? "" : std::strerror(error);
  }



  /// Setting a file to its present size frees the blocks beyond the end.
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
