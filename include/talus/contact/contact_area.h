// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_contact_area_h
#define talus_contact_contact_area_h

#include <algorithm>

namespace talus
{
  /// Volume fraction from which on a surface counts as fully covered [-],
  /// without examination of boxes.
  constexpr double volume_fraction_of_full_cells = 0.95;

  /// Share of a surface in contact [-]: @p covered, the share under the boxes
  /// of points, in a layer thinner than a cell; one where the volume fraction
  /// @p f of soil at the surface shows full cells. A small minimum is kept
  /// where soil acts on nodes beside the boxes: a maximum shear stress on no
  /// area would cancel the Coulomb friction.
  inline double
  share_in_contact(const double covered, const double f)
  {
    constexpr double begin = 0.8, end = volume_fraction_of_full_cells;
    const double     s = std::clamp((f - begin) / (end - begin), 0., 1.);
    return std::max(0.02 * f, 1. - (1. - covered) * (1. - s));
  }
} // namespace talus

#endif
