# SPDX-License-Identifier: LGPL-2.1-or-later
# Compiler and build program, before CMake says in its own words that there is none.
if(NOT CMAKE_CXX_COMPILER AND NOT DEFINED ENV{CXX})
  find_program(TALUS_COMPILER NAMES c++ g++ clang++)
  mark_as_advanced(TALUS_COMPILER)
  if(NOT TALUS_COMPILER)
    message(FATAL_ERROR
      "No C++ compiler was found. Install Debian's package build-essential, or say "
      "where one is by the environment variable CXX.")
  endif()
endif()
if(CMAKE_GENERATOR STREQUAL "Ninja" AND NOT CMAKE_MAKE_PROGRAM)
  find_program(TALUS_NINJA NAMES ninja ninja-build samu)
  mark_as_advanced(TALUS_NINJA)
  if(NOT TALUS_NINJA)
    message(FATAL_ERROR
      "The program ninja was not found, by which the presets build. Install "
      "Debian's package ninja-build, or choose another generator (cmake -G).")
  endif()
elseif(CMAKE_GENERATOR STREQUAL "Unix Makefiles" AND NOT CMAKE_MAKE_PROGRAM)
  find_program(TALUS_MAKE NAMES gmake make)
  mark_as_advanced(TALUS_MAKE)
  if(NOT TALUS_MAKE)
    message(FATAL_ERROR
      "The program make was not found. Install Debian's package build-essential.")
  endif()
endif()
