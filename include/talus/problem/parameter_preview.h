// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_parameter_preview_h
#define talus_problem_parameter_preview_h

#include <talus/materials/materials.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Data needed before the parameters can be declared.
  struct ParameterPreview
  {
    unsigned int              dimension = 2;
    std::vector<std::string>  bodies;
    std::vector<std::string>  obstacles; ///< possibly empty
    std::vector<std::string>  surfaces;  ///< possibly empty
    std::vector<MaterialName> materials;
    std::filesystem::path     folder;  ///< folder of the parameter file
    std::vector<std::string>  remarks; ///< remarks on the content of the file
  };
} // namespace talus

#endif
