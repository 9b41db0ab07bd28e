// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_project_raster_h
#define talus_terrain_project_raster_h

#include <talus/base/raster.h>

#include <string>

namespace talus
{
  /// Bring @p raster, which is in longitude and latitude (WGS 84) if it has no
  /// coordinate system, to square cells of the map with the code @p map
  /// (EPSG:32633). A value of the result is that of the cubic surface through the
  /// centres of the old cells (see HeightField) at the place of the centre of the
  /// new one; NaN where the raster does not reach, or has no datum. Cells are @p
  /// spacing wide, m; 0 stands for the smaller one of the sides that those of the
  /// raster have on the map, at its middle. Their edges are multiples of that, so
  /// that rasters with one spacing lie cell on cell.
  ///
  /// Throws ExcUser, naming @p place, if the raster cannot be in degrees, if it
  /// is so far from where the map is true that its lengths are off by more than
  /// 1 %, or if the result would have more than a hundred million cells.
  Raster
  project_raster(Raster             raster,
                 const std::string &map,
                 double             spacing,
                 const std::string &place);
} // namespace talus

#endif
