# SPDX-License-Identifier: LGPL-2.1-or-later
# Run by CPack on what it packs: paths to the libraries of this machine go.
file(GLOB_RECURSE files
  ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/talus
  ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/libtalus.so.?.?.?
  ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/_talus*.so)
list(FILTER files INCLUDE REGEX "/bin/talus$|/libtalus|/_talus")
foreach(file ${files})
  file(RPATH_REMOVE FILE ${file})
endforeach()
