// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/program.h>

// The program consists of main() only. It is compiled for the oldest supported
// processor, and any further function here would replace the version in the
// library.
int
main(int argc, char **argv)
{
  return talus::run_program(argc, argv);
}
