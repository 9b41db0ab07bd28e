// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_smooth_raster_h
#define talus_terrain_smooth_raster_h

#include <talus/base/raster.h>

namespace talus
{
  /// Replace each value of @p raster by the mean over the square of @p width,
  /// m, around it; a raster with cells wider than half of the square stays as
  /// it is. Near edges and missing values
  /// the square shrinks to equal arms, so that a plane is kept everywhere.
  void
  smooth(Raster &raster, double width);
} // namespace talus

#endif
