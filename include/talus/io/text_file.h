// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_text_file_h
#define talus_io_text_file_h

#include <filesystem>
#include <optional>
#include <string>

namespace talus
{
  /// Whether a text may come from a pipe, such as `<(command)` of a shell.
  enum class Pipes
  {
    refused,
    read
  };



  /// Throw ExcUser, naming @p name and the line, if @p content is not UTF-8.
  void
  check_utf8(const std::string &name, const std::string &content);



  /// Return a text given by the user, in UTF-8 with or without a byte order
  /// mark, which is removed; nothing if there is no file or the file cannot be
  /// read (a folder, a device). Throws ExcUser above 100 MB, and naming the
  /// line for a text in another encoding.
  std::optional<std::string>
  read_text_file(const std::filesystem::path &file,
                 Pipes                        pipes = Pipes::refused);
} // namespace talus

#endif
