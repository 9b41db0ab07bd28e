// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/program.h>

// Nothing else is in the program: it is compiled for the least processor, and a
// function that is in it, too, would take the place of the library's.
int
main(int argc, char **argv)
{
  return talus::run_program(argc, argv);
}
