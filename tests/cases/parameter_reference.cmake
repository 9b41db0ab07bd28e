# SPDX-License-Identifier: LGPL-2.1-or-later
# doc/parameters.prm is what `talus --document` prints. To make it anew:
#   talus --document > doc/parameters.prm
get_filename_component(folder ${FOUND} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${TALUS} --document OUTPUT_FILE ${FOUND}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${EXPECTED} ${FOUND}
  RESULT_VARIABLE differs)
if(differs)
  message(FATAL_ERROR "${EXPECTED} is not what the program documents. Make it "
    "anew: talus --document > doc/parameters.prm")
endif()
