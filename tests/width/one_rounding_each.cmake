# SPDX-License-Identifier: LGPL-2.1-or-later
# Included by project() in the builds of whole_runs.py: once all targets are there,
# our sources are compiled so that every operation is rounded by itself, for
# registers of WIDTH doubles.
cmake_language(DEFER CALL target_compile_options talus_objects PUBLIC
  -ffp-contract=off -fno-tree-slp-vectorize)
cmake_language(DEFER CALL target_compile_definitions talus_objects PUBLIC
  TALUS_SIMD_WIDTH=${WIDTH})
