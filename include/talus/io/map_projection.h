// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_map_projection_h
#define talus_io_map_projection_h

#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace talus
{
  /// From longitude and latitude to easting and northing on a map in metres,
  /// and back, by the library PROJ, if talus was built with it.
  class MapProjection
  {
  public:
    /// @p name: `UTM 33N` or `UTM 33S`, zone and hemisphere of the universal
    /// transverse Mercator projection in WGS 84 (the letter is not one of the
    /// bands of latitude, where S lies in the north); or `EPSG:3575`, a map by
    /// its number in PROJ's database. @p path of the parameter, for messages.
    /// Throws ExcUser if it is neither, no map in metres, or unknown to PROJ.
    MapProjection(const std::string &path, const std::string &name);

    /// Whether talus was built with PROJ; else the constructor throws.
    static bool
    is_available();

    /// The number of the map, EPSG:32633 of UTM 33N.
    const std::string &
    coordinate_system() const
    {
      return coordinate_system_;
    }

    /// Of @p place, longitude and latitude in degrees (WGS 84): easting and
    /// northing, m. Infinite where the map has no such place.
    dealii::Point<2>
    forward(const dealii::Point<2> &place) const;

    /// The other way; the longitude is between -180 and 180 degrees.
    dealii::Point<2>
    inverse(const dealii::Point<2> &place) const;

  private:
    struct Library;
    std::shared_ptr<Library> library_;
    std::string              coordinate_system_;
  };



  /// Text of a file .prj, by which a GIS knows the map of the raster beside it:
  /// the words of @p coordinate_system themselves, or, of `EPSG:32633`, Esri's
  /// dialect by PROJ. Empty where PROJ and its database do not know it.
  std::string
  well_known_text(const std::string &coordinate_system);



  /// A zone of the universal transverse Mercator projection.
  struct UtmZone
  {
    unsigned int number; ///< 1 to 60
    bool         is_south;

    /// As MapProjection knows it.
    std::string
    name() const;

    /// In WGS 84.
    unsigned int
    epsg() const
    {
      return (is_south ? 32700 : 32600) + number;
    }
  };

  /// That of a place, degrees.
  UtmZone
  utm_zone(double longitude, double latitude);
} // namespace talus

#endif
