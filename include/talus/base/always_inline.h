// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_always_inline_h
#define talus_base_always_inline_h

/// Inline a function used inside loops over points: GCC leaves some of the
/// functions out of line, where a call costs more than the body.
#define TALUS_ALWAYS_INLINE inline __attribute__((always_inline))

/// Inline a lambda function: [](...) TALUS_INLINE_LAMBDA { ... }.
#define TALUS_INLINE_LAMBDA __attribute__((always_inline))

/// Disable unrolling of a loop that usually ends after a few iterations: with
/// the flags of deal.II GCC unrolls all loops, and entering an unrolled loop
/// costs more than the loop.
#if defined(__GNUC__) && !defined(__clang__)
#  define TALUS_SHORT_LOOP _Pragma("GCC unroll 1")
#else
#  define TALUS_SHORT_LOOP
#endif

#endif
