// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_program_h
#define talus_application_program_h

namespace talus
{
  /// Run the program. Returns the exit status.
  int
  run_program(int argc, char **argv);
} // namespace talus

#endif
