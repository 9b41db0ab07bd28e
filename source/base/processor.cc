// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/processor.h>
#include <talus/base/simd.h>

namespace talus
{
  /// Compiled for each instruction set, like the kernels, hence in a separate
  /// file: the text describes the compiled code, not the machine.
  std::string
  processor()
  {
    // CMake defines TALUS_LEVEL with the value of -march.
    const std::string level = TALUS_LEVEL;
    return (level == "native"    ? "this machine (native)"
            : level == "generic" ? "any processor"
                                 : level) +
           ", " + std::to_string(simd_width) + " doubles per register";
  }
} // namespace talus
