// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_shell_h
#define talus_base_shell_h

#include <string>

namespace talus
{
  /// Return @p word as a word of a shell, for commands that the user pastes:
  /// with single quotes unless all characters are harmless.
  inline std::string
  for_shell(const std::string &word)
  {
    const std::string harmless = "abcdefghijklmnopqrstuvwxyz"
                                 "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                 "0123456789_-+=.,:/@%";
    if (!word.empty() && word.find_first_not_of(harmless) == word.npos)
      return word;
    std::string result = "'";
    for (const char c : word)
      result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
  }
} // namespace talus

#endif
