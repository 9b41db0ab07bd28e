# SPDX-License-Identifier: LGPL-2.1-or-later
# Headers for programs that lead runs or add laws: those named here, and what they
# include. talus_public_headers lists them below include/.
set(queue
  talus/application/message.h
  talus/application/parameter_file.h
  talus/application/program.h
  talus/application/run.h
  talus/materials/factory.h
  talus/materials/hyperelastic_law.templates.h
  talus/materials/rate_law.templates.h
  talus/materials/undrained_law.templates.h)
set(talus_public_headers "")
while(queue)
  list(POP_FRONT queue header)
  if(header IN_LIST talus_public_headers)
    continue()
  endif()
  list(APPEND talus_public_headers ${header})
  file(STRINGS ${CMAKE_SOURCE_DIR}/include/${header} lines
    REGEX "^ *# *include *<talus/")
  foreach(line ${lines})
    string(REGEX REPLACE ".*<(.*)>.*" "\\1" included ${line})
    list(APPEND queue ${included})
  endforeach()
endwhile()
list(REMOVE_ITEM talus_public_headers talus/version.h)
