// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_assertion_h
#define talus_base_assertion_h

#include <deal.II/base/exceptions.h>

/// Assert an invariant of the program, as deal.II's Assert does. Active in
/// Debug and, with optimised code, where CMake's TALUS_CHECKS is ON: deal.II's
/// own macro follows the variant of deal.II that is linked, and an assertion in
/// optimised code needs another switch. Throws @p exception; does not evaluate
/// @p condition where inactive.
#if defined(DEBUG) || defined(TALUS_CHECKS)
#  define TalusAssert(condition, exception) AssertThrow(condition, exception)
#else
#  define TalusAssert(condition, exception) \
    do                                      \
      {                                     \
    } while (false)
#endif

#endif
