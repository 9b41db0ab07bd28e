// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_utm_zone_h
#define talus_io_utm_zone_h

#include <string>

namespace talus
{
  /// Zone of the universal transverse Mercator projection (WGS 84).
  struct UtmZone
  {
    unsigned int number; ///< 1 to 60
    bool         is_south;

    /// Return zone and hemisphere, UTM 33N.
    std::string
    name() const;

    /// Return the code of the map, EPSG:32633.
    std::string
    epsg_code() const;
  };



  /// Return the zone at @p longitude and @p latitude, degrees.
  UtmZone
  utm_zone(double longitude, double latitude);



  /// Return the code, EPSG:32633, of the map with the user's @p name: `UTM 33N`
  /// or `UTM 33S`, zone and hemisphere (the letter is not a band of latitude,
  /// where S lies in the north), or the code itself. Throws ExcUser, with the
  /// parameter @p path, for all further names.
  std::string
  epsg_code(const std::string &path, const std::string &name);
} // namespace talus

#endif
