// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/box.h>
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/maps/geographic_motion.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Longitudes and latitudes of the centres of the cells along the edges of
    /// @p frame, which enclose all others. The first place is the middle.
    std::vector<Point<2>>
    outline_in_degrees(const Raster &frame, const std::string &map)
    {
      std::vector<Point<2>> places = {frame.middle()};
      for (unsigned int i = 0; i < frame.n_columns; ++i)
        for (const unsigned int j : {0u, frame.n_rows - 1})
          places.emplace_back(frame.x(i), frame.y(j));
      for (unsigned int j = 0; j < frame.n_rows; ++j)
        for (const unsigned int i : {0u, frame.n_columns - 1})
          places.emplace_back(frame.x(i), frame.y(j));
      MapTransformation(map, wgs_84).transform(places);
      for (Point<2> &place : places)
        {
          AssertThrow(std::isfinite(place[0]) && std::isfinite(place[1]),
                      ExcUser("'Tsunami source/Coordinates' is degrees, but "
                              "the map of the mesh has no longitude and "
                              "latitude everywhere. Check the coordinate "
                              "system of the raster and 'Grid/Origin'."));
          place[0] =
            places[0][0] + std::remainder(place[0] - places[0][0], 360.);
        }
      return places;
    }



    /// Raster in degrees that covers @p frame with one more cell on each side.
    Raster
    frame_in_degrees(const Raster &frame, const std::string &map)
    {
      // Degrees of a cell, by the motion of the middle over one cell.
      const Point<2>        middle = frame.middle();
      std::vector<Point<2>> cross  = {{middle[0] - 0.5 * frame.dx, middle[1]},
                                      {middle[0] + 0.5 * frame.dx, middle[1]},
                                      {middle[0], middle[1] - 0.5 * frame.dy},
                                      {middle[0], middle[1] + 0.5 * frame.dy}};
      MapTransformation(map, wgs_84).transform(cross);
      // Lengths of both sides in units of a degree of latitude, whatever the
      // angle between map and meridian.
      const auto length = [&](const unsigned int i) {
        const double shrink =
          std::cos(0.5 * (cross[i][1] + cross[i + 1][1]) * numbers::PI / 180.);
        return std::hypot(std::remainder(cross[i + 1][0] - cross[i][0], 360.) *
                            shrink,
                          cross[i + 1][1] - cross[i][1]);
      };
      const auto   places       = outline_in_degrees(frame, map);
      const double shrink       = std::cos(places[0][1] * numbers::PI / 180.);
      const auto [lower, upper] = bounding_box(places);
      Raster result;
      result.dx        = length(0) / shrink;
      result.dy        = length(2);
      result.n_columns = static_cast<unsigned int>(
                           std::ceil((upper[0] - lower[0]) / result.dx)) +
                         3;
      result.n_rows = static_cast<unsigned int>(
                        std::ceil((upper[1] - lower[1]) / result.dy)) +
                      3;
      result.west =
        0.5 * (lower[0] + upper[0]) - 0.5 * result.n_columns * result.dx;
      result.south =
        0.5 * (lower[1] + upper[1]) - 0.5 * result.n_rows * result.dy;
      result.coordinate_system = wgs_84;
      return result;
    }



    /// Places of the centres of the cells of @p degrees on @p map, m, as in
    /// Raster::values.
    std::vector<Point<2>>
    places_on_map(const Raster &degrees, const std::string &map)
    {
      std::vector<Point<2>> places;
      for (unsigned int j = 0; j < degrees.n_rows; ++j)
        for (unsigned int i = 0; i < degrees.n_columns; ++i)
          places.emplace_back(std::remainder(degrees.x(i), 360.), degrees.y(j));
      MapTransformation(wgs_84, map).transform(places);
      return places;
    }



    /// Interpolate linearly between the centres of the cells of @p frame; zero
    /// outside.
    double
    interpolated(const Raster              &frame,
                 const std::vector<double> &values,
                 const Point<2>            &place)
    {
      if (!std::isfinite(place[0]) || !std::isfinite(place[1]))
        return 0.;
      const double column = (place[0] - frame.x(0)) / frame.dx;
      const double row    = (frame.y(0) - place[1]) / frame.dy;
      double       result = 0;
      for (const double i : {std::floor(column), std::floor(column) + 1.})
        for (const double j : {std::floor(row), std::floor(row) + 1.})
          if (i >= 0 && i < frame.n_columns && j >= 0 && j < frame.n_rows)
            result += (1. - std::abs(column - i)) * (1. - std::abs(row - j)) *
                      values[std::size_t(j) * frame.n_columns + std::size_t(i)];
      return result;
    }
  } // namespace



  SurfaceMotion
  on_degrees(const SurfaceMotion &motion, const std::string &coordinate_system)
  {
    SurfaceMotion result = motion;
    result.frame         = frame_in_degrees(motion.frame, coordinate_system);
    const auto places    = std::make_shared<const std::vector<Point<2>>>(
      places_on_map(result.frame, coordinate_system));
    result.change = [motion, places](const unsigned int block) {
      const std::vector<double> on_map = motion.change(block);
      std::vector<double>       values;
      values.reserve(places->size());
      for (const Point<2> &place : *places)
        values.push_back(interpolated(motion.frame, on_map, place));
      return values;
    };
    return result;
  }
} // namespace talus
