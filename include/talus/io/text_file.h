// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_text_file_h
#define talus_io_text_file_h

#include <filesystem>
#include <optional>
#include <string>

namespace talus
{
  /// Whether a text may come from a pipe, as `<(command)` of a shell makes one.
  enum class Pipes
  {
    refused,
    read
  };



  /// All bytes of a text that the user has given; nothing if there is no such
  /// file, or none that can be read: a folder, a device. Throws ExcUser if it is
  /// longer than any such text.
  std::optional<std::string>
  read_text_file(const std::filesystem::path &file,
                 Pipes                        pipes = Pipes::refused);
} // namespace talus

#endif
