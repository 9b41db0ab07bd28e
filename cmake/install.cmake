# SPDX-License-Identifier: LGPL-2.1-or-later
# What `cmake --install` puts where. Components: `program`, to run, `development`, to
# build programs with laws of their own (find_package(talus)), and `python`, the
# Python module, see python/CMakeLists.txt.
include(CMakePackageConfigHelpers)

install(TARGETS talus COMPONENT program)
# To be linked to is the first one; the loader finds the others by their names.
foreach(library ${talus_libraries})
  get_target_property(folder ${library} TALUS_INSTALL_FOLDER)
  install(TARGETS ${library} LIBRARY
    DESTINATION ${folder} COMPONENT program NAMELINK_SKIP)
endforeach()
install(TARGETS talus_library LIBRARY
  DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development NAMELINK_ONLY)
install(DIRECTORY prm DESTINATION share/talus
  COMPONENT program PATTERN __pycache__ EXCLUDE)
install(FILES doc/parameters.prm DESTINATION share/doc/talus COMPONENT program)
# Tools for reports, studies and so on. All other files of share/talus keep their
# places: modules of the tools, readers of results for Python (runs need the component
# `python`), and examples.
file(GLOB tools CONFIGURE_DEPENDS share/talus/talus-*)
install(PROGRAMS ${tools} DESTINATION bin COMPONENT program)
install(DIRECTORY share/talus/ DESTINATION share/talus COMPONENT program
  PATTERN __pycache__ EXCLUDE
  PATTERN talus.bash EXCLUDE
  REGEX "/share/talus/talus-[^/]*$" EXCLUDE)
# The tools compare with the reference of all parameters.
install(FILES doc/parameters.prm DESTINATION share/talus COMPONENT program)

# The pages name the options of `--help`, as tests check. Debian wants them packed.
find_program(TALUS_GZIP gzip REQUIRED)
mark_as_advanced(TALUS_GZIP)
file(GLOB man_pages CONFIGURE_DEPENDS doc/man/*.1)
foreach(source ${man_pages})
  get_filename_component(name ${source} NAME)
  set(page ${CMAKE_BINARY_DIR}/${name}.gz)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
  execute_process(COMMAND ${TALUS_GZIP} -9nc ${source}
    OUTPUT_FILE ${page} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${page} DESTINATION share/man/man1 COMPONENT program)
endforeach()
# bash looks for a file with the name of the command.
foreach(command talus ${tools})
  get_filename_component(name ${command} NAME)
  install(FILES share/talus/talus.bash RENAME ${name}
    DESTINATION share/bash-completion/completions COMPONENT program)
endforeach()

# deal.II's headers are others where they assert.
set(talus_deal_ii_variant RELEASE)
set(talus_deal_ii_definitions "")
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(talus_deal_ii_variant DEBUG)
  set(talus_deal_ii_definitions DEBUG)
endif()
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/talus)
configure_package_config_file(cmake/talusConfig.cmake.in
  ${CMAKE_BINARY_DIR}/talusConfig.cmake
  INSTALL_DESTINATION ${config_folder}
  PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/talusConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
    ${CMAKE_BINARY_DIR}/talusConfig.cmake
    ${CMAKE_BINARY_DIR}/talusConfigVersion.cmake
    cmake/any_linker.cmake
  DESTINATION ${config_folder} COMPONENT development)
include(cmake/public_headers.cmake)
foreach(header ${talus_public_headers})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES include/${header}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT development)
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/include/talus/version.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/talus COMPONENT development)
install(DIRECTORY doc/examples DESTINATION share/talus COMPONENT development)
