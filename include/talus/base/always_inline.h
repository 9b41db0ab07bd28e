// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_always_inline_h
#define talus_base_always_inline_h

/// For functions inside the loops over points: GCC leaves some of them out of
/// line, which costs more than they do.
#define TALUS_ALWAYS_INLINE inline __attribute__((always_inline))

/// The same for a lambda function: [](...) TALUS_INLINE_LAMBDA { ... }.
#define TALUS_INLINE_LAMBDA __attribute__((always_inline))

/// In front of a loop that usually ends after a few turns: with deal.II's flags
/// GCC unrolls all loops, and then most of the work is to find the way in.
#if defined(__GNUC__) && !defined(__clang__)
#  define TALUS_SHORT_LOOP _Pragma("GCC unroll 1")
#else
#  define TALUS_SHORT_LOOP
#endif

#endif
