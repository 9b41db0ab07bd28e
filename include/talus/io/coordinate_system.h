// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_coordinate_system_h
#define talus_io_coordinate_system_h

#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

class OGRCoordinateTransformation;

namespace talus
{
  /// Unit of the coordinates on a map.
  enum class MapUnit
  {
    unknown,
    degrees, ///< longitude and latitude
    metres,  ///< easting and northing
    other    ///< feet, for example
  };



  /// Longitude and latitude, degrees, in WGS 84.
  inline const std::string wgs_84 = "EPSG:4326";



  /// Return the unit of the coordinates in @p coordinate_system, a
  /// Raster::coordinate_system.
  MapUnit
  map_unit(const std::string &coordinate_system);



  /// Throw ExcUser, beginning with @p file, if @p coordinate_system is given
  /// but not understood: the unit of the coordinates would be a guess.
  void
  check_understood(const std::string &coordinate_system,
                   const std::string &file);



  /// Remove the vertical axis from @p coordinate_system. Return the length of
  /// the axis' unit, m, negative if the axis points down; 0 without an axis.
  double
  strip_vertical_axis(std::string &coordinate_system);



  /// Return the text of a file .prj, by which a GIS knows the map of the raster
  /// beside the file: @p coordinate_system in Esri's dialect of well-known
  /// text. A text unknown to GDAL is returned unchanged; the result is empty
  /// for a code (EPSG:32633) unknown to GDAL.
  std::string
  well_known_text(const std::string &coordinate_system);



  /// Return the code, EPSG:32633, of the map with the user's @p name: `UTM 33N`
  /// or `UTM 33S`, zone and hemisphere (the letter is not a band of latitude,
  /// where S lies in the north), or the code itself. Throws ExcUser, with the
  /// parameter @p path, for all further names, and for maps that are not in
  /// metres.
  std::string
  map_code(const std::string &path, const std::string &name);



  /// Return the name, UTM 33N, of the zone at @p place of the @p
  /// coordinate_system; without a system in longitude and latitude, degrees.
  std::string
  utm_zone(const dealii::Point<2> &place,
           const std::string      &coordinate_system = wgs_84);



  /// Transformation of places from one coordinate system to another.
  class MapTransformation
  {
  public:
    /// @p from and @p to are as Raster::coordinate_system. Throws ExcUser if
    /// GDAL knows no transformation between them.
    MapTransformation(const std::string &from, const std::string &to);

    /// Transform @p places: longitude and latitude, degrees, or easting and
    /// northing, m. The result is infinite where the target system has no place
    /// for a point; resulting longitudes are between -180 and 180 degrees.
    /// @p third has the coordinate of each place along a third axis, m.
    void
    transform(std::vector<dealii::Point<2>> &places,
              std::vector<double>           *third = nullptr) const;

  private:
    std::shared_ptr<OGRCoordinateTransformation> transformation_;
  };



  /// Return the lengths, m, of straight lines through the Earth (WGS 84)
  /// between successive pairs of @p places of the @p coordinate_system.
  /// Infinite or NaN for a place that is none.
  std::vector<double>
  lengths_on_earth(std::vector<dealii::Point<2>> places,
                   const std::string            &coordinate_system);
} // namespace talus

#endif
