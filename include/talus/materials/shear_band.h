// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_shear_band_h
#define talus_materials_shear_band_h

#include <string>

namespace talus
{
  /// How a material without a length of its own softens in simple shear.
  struct Softening
  {
    std::string section;       ///< of the material in the parameter file
    double      strain;        ///< plastic shear strain to lose `share`
    double      work;          ///< above the strength that remains, J/m^3
    std::string share_of_loss; ///< "all", or for example "95 %"
  };

  /// A shear band of softening material settles in about one row of cells, so
  /// that displacement and work to soften it are proportional to @p cell_size
  /// (m). Sentences with both numbers on these cells and on cells of half the
  /// size; @p advice is what the user can do, the end of a sentence that starts
  /// with "When you change the cell size, ".
  std::string
  shear_band_note(const Softening   &softening,
                  double             cell_size,
                  const std::string &advice);
} // namespace talus

#endif
