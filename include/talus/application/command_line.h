// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_command_line_h
#define talus_application_command_line_h

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace talus
{
  /// What the command line asks for.
  struct CommandLine
  {
    std::string              parameter_file;
    std::vector<std::string> overrides;
    std::string              output_folder;
    bool                     validate  = false;
    bool                     document  = false;
    bool                     resume    = false;
    bool                     overwrite = false;
  };

  /// Parse the command line. Prints and returns nothing where only help or the
  /// version is asked for. Throws if it makes no sense.
  std::optional<CommandLine>
  parse_command_line(int argc, const char *const *argv);

  /// Print all parameters of all laws with their documentation and defaults, in
  /// the form of a parameter file.
  void
  document(std::ostream &out);
} // namespace talus

#endif
