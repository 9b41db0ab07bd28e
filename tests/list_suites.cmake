# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes FILE, an entry of ctest for each suite of PROGRAM and number of ranks;
# run whenever PROGRAM was linked. MPIRUN is the command and its option for the
# number of ranks, ENVIRONMENT what it wants to be told.
execute_process(COMMAND ${PROGRAM} --list-tests
  OUTPUT_VARIABLE tests OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
# Of each test the suite and its numbers of ranks.
string(REGEX REPLACE "\\.[^ \n]*" "" suites "${tests}")
string(REPLACE "\n" ";" suites "${suites}")
list(REMOVE_DUPLICATES suites)
set(content "")
foreach(line ${suites})
  separate_arguments(ranks UNIX_COMMAND "${line}")
  list(POP_FRONT ranks suite)
  foreach(n ${ranks})
    set(entry unit/${suite})
    set(mpirun "")
    set(properties "LABELS single")
    if(n GREATER 1)
      string(APPEND entry .${n}ranks)
      list(JOIN MPIRUN "\" \"" mpirun)
      set(mpirun "\"${mpirun}\" ${n} ")
      string(APPEND properties
        " PROCESSORS 2 TIMEOUT 900 ENVIRONMENT \"${ENVIRONMENT}\"")
    endif()
    string(APPEND content
      "add_test(${entry} ${mpirun}\"${PROGRAM}\" --gtest_filter=${suite}.*)\n"
      "set_tests_properties(${entry} PROPERTIES ${properties})\n")
  endforeach()
endforeach()
file(WRITE ${FILE} "${content}")
