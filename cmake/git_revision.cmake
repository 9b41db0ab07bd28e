# SPDX-License-Identifier: LGPL-2.1-or-later
# TALUS_GIT_REVISION: abbreviated hash of the commit that is checked out, "unknown"
# outside of a repository. deal.II's query looks for .git/HEAD, but in a worktree
# .git is a file that says where the repository is: so git is asked for all of it.
set(TALUS_GIT_REVISION unknown)
find_package(Git QUIET)
# Not the revision of a repository that only happens to lie around the sources.
if(GIT_FOUND AND EXISTS ${CMAKE_SOURCE_DIR}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --short HEAD
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} RESULT_VARIABLE git_result
    OUTPUT_VARIABLE git_output OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(git_result EQUAL 0)
    set(TALUS_GIT_REVISION ${git_output})
  endif()
  # That file grows with each commit and checkout: configure again then.
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --git-path logs/HEAD
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} RESULT_VARIABLE git_result
    OUTPUT_VARIABLE git_output OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  get_filename_component(git_output "${git_output}" ABSOLUTE BASE_DIR ${CMAKE_SOURCE_DIR})
  if(git_result EQUAL 0 AND EXISTS ${git_output})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${git_output})
  endif()
endif()
