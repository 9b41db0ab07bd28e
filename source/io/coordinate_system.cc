// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/gdal.h>

#include <boost/algorithm/string/predicate.hpp>

#include <cmath>
#include <cstdlib>
#include <regex>

namespace talus
{
  using namespace dealii;

  // Files and addresses in place of a description are not opened. Old files
  // .prj of Arc have lines such as `Projection UTM` and `Units FEET`.
  std::optional<OGRSpatialReference>
  spatial_reference(const std::string &words)
  {
    const QuietGdal     quiet;
    OGRSpatialReference system;
    CPLStringList       lines(CSLTokenizeString2(words.c_str(), "\r\n", 0));
    const OGRErr        error =
      boost::istarts_with(words, "projection")
               ? system.importFromESRI(lines.List())
               : system.SetFromUserInput(
            words.c_str(),
            OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get());
    if (words.empty() || error != OGRERR_NONE)
      return {};
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return system;
  }



  std::string
  export_to_text(const OGRSpatialReference &system, const char *const *options)
  {
    const QuietGdal quiet;
    char           *words = nullptr;
    const OGRErr    error = system.exportToWkt(&words, options);
    std::string     result(error == OGRERR_NONE ? words : "");
    CPLFree(words);
    return result;
  }



  MapUnit
  map_unit(const std::string &coordinate_system)
  {
    const auto system = spatial_reference(coordinate_system);
    if (!system)
      return MapUnit::unknown;
    if (system->IsGeographic())
      return std::abs(system->GetAngularUnits() * 180. / M_PI - 1.) < 1e-9
               ? MapUnit::degrees
               : MapUnit::other;
    return system->GetLinearUnits() == 1. ? MapUnit::metres : MapUnit::other;
  }



  void
  check_understood(const std::string &coordinate_system,
                   const std::string &file)
  {
    AssertThrow(coordinate_system.empty() ||
                  spatial_reference(coordinate_system),
                ExcUser(file + " has the coordinate system '" +
                        coordinate_system.substr(0, 60) +
                        "', which GDAL does not know: the unit of the "
                        "coordinates would be a guess. Write the system as "
                        "well-known text or EPSG:NUMBER."));
  }



  double
  strip_vertical_axis(std::string &coordinate_system)
  {
    auto system = spatial_reference(coordinate_system);
    if (!system || !system->IsVertical())
      return 0.;
    OGRAxisOrientation direction = OAO_Up;
    system->GetAxis("VERT_CS", 0, &direction);
    const double unit   = system->GetTargetLinearUnits("VERT_CS");
    const bool has_more = system->IsCompound() && system->StripVertical() == 0;
    coordinate_system   = has_more ? export_to_text(*system) : "";
    return direction == OAO_Down ? -unit : unit;
  }



  std::string
  well_known_text(const std::string &coordinate_system)
  {
    const char *const dialect[] = {"FORMAT=WKT1_ESRI", nullptr};
    const auto        system    = spatial_reference(coordinate_system);
    const std::string words = system ? export_to_text(*system, dialect) : "";
    return words.empty() && coordinate_system.rfind("EPSG:", 0) != 0
             ? coordinate_system
             : words;
  }



  std::string
  map_code(const std::string &path, const std::string &name)
  {
    std::smatch parts;
    std::string code = name;
    if (std::regex_match(name,
                         parts,
                         std::regex("UTM ?([1-9]|[1-5][0-9]|60)([NS])")))
      code =
        text("EPSG:", (parts[2] == "S" ? 32700 : 32600) + std::stoi(parts[1]));
    AssertThrow(
      std::regex_match(code, std::regex("EPSG:[0-9]+")) &&
        map_unit(code) == MapUnit::metres,
      ExcUser(text(path,
                   " = '",
                   name,
                   "' was found, where a UTM zone from 1 to 60 and a "
                   "hemisphere were expected, such as UTM 33N or UTM 33S, or "
                   "the code of a map in metres that GDAL knows, such as "
                   "EPSG:3575. Correct the entry.")));
    return code;
  }



  std::string
  utm_zone(const Point<2> &place, const std::string &coordinate_system)
  {
    std::vector<Point<2>> places = {place};
    if (map_unit(coordinate_system) != MapUnit::degrees)
      MapTransformation(coordinate_system, wgs_84).transform(places);
    const double turns = (places[0][0] + 180.) / 360.;
    return text("UTM ",
                1 + static_cast<int>(60. * (turns - std::floor(turns))),
                places[0][1] < 0. ? 'S' : 'N');
  }



  MapTransformation::MapTransformation(const std::string &from,
                                       const std::string &to)
  {
    const QuietGdal quiet;
    const auto      source = spatial_reference(from);
    const auto      target = spatial_reference(to);
    if (source && target)
      transformation_.reset(
        OGRCreateCoordinateTransformation(&*source, &*target));
    AssertThrow(transformation_,
                ExcUser(text(
                  "GDAL has no transformation from the coordinate "
                  "system '",
                  from.substr(0, 60),
                  "' to '",
                  to.substr(0, 60),
                  "' (",
                  CPLGetLastErrorMsg(),
                  "). Give the file in a coordinate system that GDAL knows.")));
  }



  void
  MapTransformation::transform(std::vector<Point<2>> &places,
                               std::vector<double>   *third) const
  {
    const QuietGdal     quiet;
    std::vector<double> x, y;
    for (const Point<2> &place : places)
      {
        x.push_back(place[0]);
        y.push_back(place[1]);
      }
    std::vector<int> is_done(places.size());
    transformation_->Transform(places.size(),
                               x.data(),
                               y.data(),
                               third ? third->data() : nullptr,
                               is_done.data());
    for (std::size_t i = 0; i < places.size(); ++i)
      places[i] =
        is_done[i] ? Point<2>(x[i], y[i]) : Point<2>(HUGE_VAL, HUGE_VAL);
  }



  // By the axes of the Earth, EPSG:4978. In a cell of a degree, chord and arc
  // differ by a hundred-thousandth.
  std::vector<double>
  lengths_on_earth(std::vector<Point<2>> places,
                   const std::string    &coordinate_system)
  {
    std::vector<double> z(places.size(), 0.), lengths;
    MapTransformation(coordinate_system, "EPSG:4978").transform(places, &z);
    for (std::size_t i = 0; i + 1 < places.size(); i += 2)
      lengths.push_back(
        std::hypot(places[i].distance(places[i + 1]), z[i] - z[i + 1]));
    return lengths;
  }
} // namespace talus
