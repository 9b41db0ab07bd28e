// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_command_line_h
#define talus_application_command_line_h

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace talus
{
  /// Options and arguments of the command line.
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

  /// Parse the command line. Prints help, version and the like and then returns
  /// nothing. Throws if the command line is invalid.
  std::optional<CommandLine>
  parse_command_line(int argc, const char *const *argv);

  /// Print the reference of all parameters of all laws, with documentation and
  /// defaults, in the form of a parameter file.
  void
  document(std::ostream &out);
} // namespace talus

#endif
