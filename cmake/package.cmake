# SPDX-License-Identifier: LGPL-2.1-or-later
# Packages for Debian: `cpack` in the folder of the preset `dist`. `talus` is the
# program, with a library for each level of processors; `talus-dev` is for programs
# with laws of their own; `python3-talus` is the Python module, if it was built.
# The date is that of the commit, so that the same sources give the same package.
execute_process(COMMAND git log -1 --format=%cD
  WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT date)
  string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
endif()
# Who makes the package, as Debian's own tools are told.
set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
if(NOT DEFINED ENV{DEBFULLNAME} OR NOT DEFINED ENV{DEBEMAIL})
  set(maintainer "The talus authors <talus@localhost>")
endif()
file(WRITE ${CMAKE_BINARY_DIR}/changelog.Debian
  "talus (${PROJECT_VERSION}-1) unstable; urgency=medium\n\n"
  "  * What changed is told in CHANGELOG.md of the sources.\n\n"
  " -- ${maintainer}  ${date}\n")
file(WRITE ${CMAKE_BINARY_DIR}/copyright
  "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\n"
  "Upstream-Name: talus\n\n"
  "Files: *\nCopyright: 2026 The talus authors\nLicense: LGPL-2.1+\n"
  " On Debian systems, the full text of the GNU Lesser General Public License\n"
  " version 2.1 is in the file '/usr/share/common-licenses/LGPL-2.1'.\n")
execute_process(COMMAND ${TALUS_GZIP} -9nkf ${CMAKE_BINARY_DIR}/changelog.Debian)
# The library is for talus and talus-dev alone, and so in the package of the program.
file(WRITE ${CMAKE_BINARY_DIR}/overrides.talus
  "talus: package-name-doesnt-match-sonames\n"
  "talus: initial-upload-closes-no-bugs\n"
  "# CPack's own scripts, which do what the trigger does.\n"
  "talus: maintscript-calls-ldconfig *\n")
file(WRITE ${CMAKE_BINARY_DIR}/overrides.talus-dev
  "talus-dev: initial-upload-closes-no-bugs\n")
file(WRITE ${CMAKE_BINARY_DIR}/shlibs
  "libtalus 0.1 talus (= ${PROJECT_VERSION}-1)\n")
file(WRITE ${CMAKE_BINARY_DIR}/triggers "activate-noawait ldconfig\n")
set(packages program:talus development:talus-dev)
if(talus_has_python)
  file(WRITE ${CMAKE_BINARY_DIR}/overrides.python3-talus
    "python3-talus: initial-upload-closes-no-bugs\n")
  list(APPEND packages python:python3-talus)
endif()
foreach(pair ${packages})
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  install(FILES ${CMAKE_BINARY_DIR}/copyright ${CMAKE_BINARY_DIR}/changelog.Debian.gz
    DESTINATION share/doc/${package} COMPONENT ${component})
  install(FILES ${CMAKE_BINARY_DIR}/overrides.${package} RENAME ${package}
    DESTINATION share/lintian/overrides COMPONENT ${component})
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${package})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(talus_has_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${maintainer})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# Needed by the tools: Python, the packages that the tools name where a module is
# missing, and a package for films.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "python3:any")
string(CONCAT CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS
  "python3-numpy, python3-matplotlib, python3-pil, python3-jinja2, python3-scipy, "
  "python3-sklearn, python3-gdal, libopenblas0-serial")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA
  ${CMAKE_BINARY_DIR}/shlibs ${CMAKE_BINARY_DIR}/triggers)
# Of a package the loader finds the libraries without.
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/without_rpath.cmake)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "talus (= ${PROJECT_VERSION}-1), libdeal.ii-dev, libxsimd-dev, libboost-program-options-dev")
if(talus_has_python)
  # The compiled part is for one version of Python.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  string(CONCAT CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "talus (= ${PROJECT_VERSION}-1), python3-numpy, "
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_minor})")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-mpi4py")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"The Python module talus: runs that a program leads step by step, with points as
arrays of numpy and obstacles moved by functions, and readers of results.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"How far the soil runs, how fast, and how it comes to rest: in plane strain and
in 3-D, from equilibrium and factor of safety to the run-out, with obstacles.
Tools write reports (talus-report), comparisons (talus-compare) and films
(talus-animate), run studies (talus-study), fit parameters to an observed deposit
(talus-calibrate), compute the response of a pipeline (talus-pipe), and write the
source of a tsunami model (talus-tsunami).")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Headers and the files of CMake for programs that lead runs or have constitutive
laws of their own, and an example of such a program.")
include(CPack)
