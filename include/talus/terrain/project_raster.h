// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_project_raster_h
#define talus_terrain_project_raster_h

#include <talus/base/box.h>
#include <talus/base/raster.h>

#include <string>

namespace talus
{
  /// Replace each value of @p raster by the mean over the square of @p width,
  /// m, around it; a raster with cells wider than half of the square stays as
  /// it is. Near edges and missing values
  /// the square shrinks to equal arms, so that a plane is kept everywhere.
  void
  smooth(Raster &raster, double width);



  /// Project @p raster to square cells on the map with the code @p map
  /// (EPSG:32633). A raster without coordinate system is in longitude and
  /// latitude (WGS 84). The value of a new cell is the height of the cubic
  /// surface through the centres of the old cells (see HeightField) at the
  /// centre of the new cell; NaN outside of the raster, or without datum. Cells
  /// are @p spacing wide, m; for 0 as wide as the shorter side of the cell in
  /// the middle of the raster, measured on the map. Edges of cells are
  /// multiples of the spacing: rasters with equal spacing lie cell on cell.
  ///
  /// Throws ExcUser, naming @p place, if the raster cannot be in degrees, if
  /// the map distorts lengths in the raster by more than 1 %, or if the result
  /// would have more than a hundred million cells.
  Raster
  project_raster(Raster             raster,
                 const std::string &map,
                 double             spacing,
                 const std::string &place);



  /// Return the part of the raster @p whole around @p box, without values. A
  /// raster of up to four million cells is its own part. The part extends
  /// beyond the box by the extent of the box and sixteen cells on each side:
  /// the mesh may grow, and pipes go on beyond the mesh.
  /// @param whole frame of the raster
  /// @param box easting and northing, m, of the mesh
  /// @param map code of the map of @p box, empty for the map of the raster
  Raster
  part_around(const Raster &whole, const Box<2> &box, const std::string &map);
} // namespace talus

#endif
