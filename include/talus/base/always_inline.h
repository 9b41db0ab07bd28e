#ifndef talus_base_always_inline_h
#define talus_base_always_inline_h

/// For functions inside the loops over points: GCC leaves some of them out of
/// line, which costs more than they do.
#define TALUS_ALWAYS_INLINE inline __attribute__((always_inline))

/// The same for a lambda function: [](...) TALUS_INLINE_LAMBDA { ... }.
#define TALUS_INLINE_LAMBDA __attribute__((always_inline))

#endif
