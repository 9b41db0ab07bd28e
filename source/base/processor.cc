// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/processor.h>
#include <talus/base/simd.h>

namespace talus
{
  /// In a file of its own, since it is compiled for each level of the
  /// processor, as the kernels are: it says what was compiled, not what the
  /// machine could do.
  std::string
  processor()
  {
    // TALUS_LEVEL is what CMake gave the compiler as -march.
    const std::string level = TALUS_LEVEL;
    return (level == "native"    ? "this machine (native)"
            : level == "generic" ? "any processor"
                                 : level) +
           ", " + std::to_string(simd_width) + " doubles per register";
  }
} // namespace talus
