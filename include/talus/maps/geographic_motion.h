// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_geographic_motion_h
#define talus_maps_geographic_motion_h

#include <talus/io/surface_motion.h>

#include <string>

namespace talus
{
  /// Return @p motion on a raster in longitude and latitude, degrees, WGS 84,
  /// that covers the raster of @p motion. A cell in the middle is as large as a
  /// cell of @p motion. Values are interpolated linearly between the centres of
  /// cells, and zero outside, so the volume is that of @p motion up to the
  /// error of interpolation. Longitudes continue beyond 180 degrees where the
  /// raster lies on both sides.
  /// @param motion on a map in metres
  /// @param coordinate_system of the map, see Raster::coordinate_system. Throws
  ///   ExcUser if no transformation exists.
  SurfaceMotion
  on_degrees(const SurfaceMotion &motion, const std::string &coordinate_system);
} // namespace talus

#endif
