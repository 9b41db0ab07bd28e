// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_shear_band_h
#define talus_materials_shear_band_h

#include <talus/base/remark.h>

#include <string>

namespace talus
{
  /// Softening in simple shear of a material without a length scale.
  struct Softening
  {
    std::string section;       ///< section of the material in the parameters
    double      strain;        ///< plastic shear strain to lose `share_of_loss`
    double      work;          ///< above the remaining strength, J/m^3
    std::string share_of_loss; ///< "all", or for example "95 %"
  };

  /// Return a remark on the cell size. A shear band of material that softens by
  /// strain is as wide as a row of cells, so displacement and work of softening
  /// are proportional to the cell size. The remark gives both numbers for
  /// @p cell_size, m, and for half of @p cell_size. @p advice ends the sentence
  /// "When you change the cell size, ...".
  Remark
  shear_band_note(const Softening   &softening,
                  double             cell_size,
                  const std::string &advice);

  /// Softening in simple shear of a material with a softening displacement.
  struct SofteningOfBand
  {
    std::string section;       ///< section of the material in the parameters
    double      displacement;  ///< across the band to lose `share_of_loss`, m
    double      work;          ///< above the remaining strength, J/m^2
    std::string share_of_loss; ///< "all", or for example "95 %"
  };

  /// Return information on the bands for which the displacement holds.
  Remark
  band_note(const SofteningOfBand &softening);
} // namespace talus

#endif
