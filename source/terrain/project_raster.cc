// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/height_field.h>
#include <talus/io/coordinate_system.h>
#include <talus/terrain/project_raster.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Smooth the @p n values from @p first on, @p stride apart, over @p reach
    /// values on each side, with sums up to each value and the numbers of
    /// values since the last missing one.
    void
    smooth_line(double           *first,
                const std::size_t stride,
                const std::size_t n,
                const std::size_t reach)
    {
      std::vector<double>      sum(n + 1, 0.);
      std::vector<std::size_t> before(n), behind(n);
      const auto               known = [&](const std::size_t i) {
        return !std::isnan(first[i * stride]);
      };
      for (std::size_t i = 0; i < n; ++i)
        {
          sum[i + 1] = sum[i] + (known(i) ? first[i * stride] : 0.);
          before[i]  = i > 0 && known(i - 1) ? before[i - 1] + 1 : 0;
        }
      for (std::size_t i = n; i-- > 0;)
        behind[i] = i + 1 < n && known(i + 1) ? behind[i + 1] + 1 : 0;
      for (std::size_t i = 0; i < n; ++i)
        if (const auto arm = std::min({reach, before[i], behind[i]});
            known(i) && arm > 0)
          first[i * stride] =
            (sum[i + arm + 1] - sum[i - arm]) / (2. * arm + 1.);
    }
  } // namespace



  void
  smooth(Raster &raster, const double width)
  {
    const std::size_t reach_x =
                        std::lround(std::floor(0.5 * width / raster.dx)),
                      reach_y =
                        std::lround(std::floor(0.5 * width / raster.dy)),
                      columns = raster.n_columns, rows = raster.n_rows;
    double *const values = raster.values.data();
    for (std::size_t r = 0; r < rows && reach_x > 0; ++r)
      smooth_line(values + r * columns, 1, columns, reach_x);
    for (std::size_t c = 0; c < columns && reach_y > 0; ++c)
      smooth_line(values + c, columns, rows, reach_y);
    if (reach_x + reach_y > 0)
      raster.smoothed_over = width;
  }



  namespace
  {
    /// Size and distortion of a cell, the extremes over both axes.
    struct CellSize
    {
      double on_map;   ///< shorter side on the map, m
      double too_long; ///< larger relative error of lengths on the map [-]
    };



    /// Return the sizes of a cell at each of @p places of the raster.
    std::vector<CellSize>
    cell_sizes(const Raster                &raster,
               const std::string           &map,
               const std::vector<Point<2>> &places)
    {
      constexpr double      inf = std::numeric_limits<double>::infinity();
      std::vector<Point<2>> ends;
      for (const Point<2> &place : places)
        for (const auto &step :
             {Point<2>(0.5 * raster.dx, 0.), Point<2>(0., 0.5 * raster.dy)})
          {
            ends.push_back(Point<2>(place - step));
            ends.push_back(place + step);
          }
      const auto truth = lengths_on_earth(ends, raster.coordinate_system);
      MapTransformation(raster.coordinate_system, map).transform(ends);
      std::vector<CellSize> result(places.size(), {inf, 0.});
      for (std::size_t i = 0; i < truth.size(); ++i)
        {
          const double length = ends[2 * i].distance(ends[2 * i + 1]);
          const double error  = std::abs(length / truth[i] - 1.);
          CellSize    &size   = result[i / 2];
          size.on_map         = std::min(size.on_map, length);
          size.too_long =
            std::isfinite(error) ? std::max(size.too_long, error) : inf;
        }
      return result;
    }



    /// Return corners of the cells along the edges: straight edges are bent on
    /// the map.
    std::vector<Point<2>>
    outline(const Raster &raster)
    {
      std::vector<Point<2>> result;
      for (unsigned int i = 0; i <= raster.n_columns; ++i)
        for (const double y : {raster.south, raster.north()})
          result.emplace_back(raster.west + i * raster.dx, y);
      for (unsigned int i = 0; i <= raster.n_rows; ++i)
        for (const double x : {raster.west, raster.east()})
          result.emplace_back(x, raster.south + i * raster.dy);
      return result;
    }



    /// Check that a raster without coordinate system may be in degrees.
    void
    check_degrees(const Raster &raster, const std::string &place)
    {
      const double east  = raster.east();
      const double north = raster.north();
      const double slack = raster.dx; // half a cell beyond the poles
      AssertThrow(
        std::max(std::abs(raster.west), std::abs(east)) <= 360. + slack &&
          std::max(std::abs(raster.south), std::abs(north)) <= 90. + slack,
        ExcUser(text(place,
                     " is set for a raster that reaches from ",
                     raster.west,
                     " to ",
                     east,
                     " and from ",
                     raster.south,
                     " to ",
                     north,
                     ", which are no longitudes and latitudes in degrees, and "
                     "has no coordinate system. Remove the entry if the raster "
                     "is in metres, or put a file .prj beside the raster.")));
    }



    void
    check_scale(const Raster                &raster,
                const std::string           &map,
                const std::vector<Point<2>> &places,
                const std::string           &place)
    {
      const auto sizes = cell_sizes(raster, map, places);
      for (std::size_t i = 0; i < places.size(); ++i)
        AssertThrow(
          sizes[i].too_long <= 0.01,
          ExcUser(text(place,
                       " projects a raster whose lengths would be wrong by ",
                       100. * sizes[i].too_long,
                       " % at its place (",
                       places[i],
                       "), where at most 1 % was expected. Choose another map "
                       "(in its middle the raster is in the zone ",
                       utm_zone(raster.middle(), raster.coordinate_system),
                       "), or cut out the part you need.")));
    }



    /// Transform places of a map to the coordinates of @p raster, whose
    /// longitudes may count from 0 to 360.
    void
    bring_to_raster(std::vector<Point<2>>   &places,
                    const MapTransformation &from_map,
                    const Raster            &raster)
    {
      from_map.transform(places);
      if (map_unit(raster.coordinate_system) == MapUnit::degrees)
        for (Point<2> &x : places)
          x[0] += 360. * std::round((raster.middle()[0] - x[0]) / 360.);
    }



    /// Return cells of size @p spacing that cover the outline @p corners on the
    /// map, without values.
    Raster
    frame(const std::vector<Point<2>> &corners,
          const double                 spacing,
          const std::string           &place)
    {
      const auto [lower, upper] = bounding_box(corners);
      Raster result;
      result.dx = result.dy  = spacing;
      result.west            = spacing * std::floor(lower[0] / spacing);
      result.south           = spacing * std::floor(lower[1] / spacing);
      const double n_columns = std::ceil((upper[0] - result.west) / spacing);
      const double n_rows    = std::ceil((upper[1] - result.south) / spacing);
      AssertThrow(n_columns * n_rows <= 1e8,
                  ExcUser(text(place,
                               " makes a raster of ",
                               n_columns,
                               " columns and ",
                               n_rows,
                               " rows of ",
                               spacing,
                               " m, where up to a hundred million cells are "
                               "possible. Choose larger cells, or cut out the "
                               "part you need.")));
      result.n_columns = n_columns;
      result.n_rows    = n_rows;
      return result;
    }
  } // namespace



  // Backwards, from each centre of a new cell to the old cells: values are
  // interpolated in the lattice of the raster, without a shift by half a cell.
  // GDAL's warper has a cubic kernel, too, and with XSCALE and YSCALE of 1
  // gives a plane back inside, but beside the edges and beside cells without
  // data it misses the plane by the slope over a cell.
  Raster
  project_raster(Raster             raster,
                 const std::string &map,
                 const double       spacing,
                 const std::string &place)
  {
    if (raster.coordinate_system.empty())
      {
        check_degrees(raster, place);
        raster.coordinate_system = wgs_84;
      }
    auto edge = outline(raster);
    edge.push_back(raster.middle());
    check_scale(raster, map, edge, place);
    const double own = cell_sizes(raster, map, {edge.back()})[0].on_map;
    MapTransformation(raster.coordinate_system, map).transform(edge);
    Raster result            = frame(edge, spacing > 0 ? spacing : own, place);
    result.nodata            = raster.nodata;
    result.coordinate_system = map;
    const MapTransformation from_map(map, raster.coordinate_system);
    const HeightField       heights(std::move(raster));
    result.values.reserve(std::size_t(result.n_rows) * result.n_columns);
    for (unsigned int r = 0; r < result.n_rows; ++r)
      {
        std::vector<Point<2>> row;
        for (unsigned int i = 0; i < result.n_columns; ++i)
          row.emplace_back(result.x(i), result.y(r));
        bring_to_raster(row, from_map, heights.raster());
        for (const Point<2> &x : row)
          {
            const auto value = heights.at(x);
            result.values.push_back(
              value ? value->height : std::numeric_limits<double>::quiet_NaN());
          }
      }
    return result;
  }



  namespace
  {
    /// Return the bounding box of places on the edge of @p box in the
    /// coordinates of @p raster.
    Box<2>
    on_raster(const Box<2> &box, Raster raster, const std::string &map)
    {
      constexpr unsigned int n = 32; // edges are bent
      Raster                 edge;
      edge.n_columns = edge.n_rows = n;
      edge.west                    = box.lower[0];
      edge.south                   = box.lower[1];
      edge.dx                      = box.length(0) / n;
      edge.dy                      = box.length(1) / n;
      auto places                  = outline(edge);
      if (raster.coordinate_system.empty())
        raster.coordinate_system = wgs_84;
      if (!map.empty())
        bring_to_raster(places,
                        MapTransformation(map, raster.coordinate_system),
                        raster);
      return bounding_box(places);
    }
  } // namespace



  Raster
  part_around(const Raster &whole, const Box<2> &box, const std::string &map)
  {
    if (double(whole.n_columns) * whole.n_rows <= 4e6)
      return whole;
    const Box<2> needed = on_raster(box, whole, map);
    // First number and number of cells, from west or south.
    const auto range = [&](const unsigned int d,
                           const double       edge,
                           const double       size,
                           const double       n) {
      const double margin = needed.length(d) + 16. * size;
      const double first =
        std::clamp(std::floor((needed.lower[d] - margin - edge) / size),
                   0.,
                   n - 2.);
      const double end =
        std::clamp(std::ceil((needed.upper[d] + margin - edge) / size),
                   first + 2.,
                   n);
      return std::pair<double, double>(first, end - first);
    };
    AssertThrow(std::isfinite(needed.length(0) + needed.length(1)),
                ExcUser("The mesh has corners without a place on the map of a "
                        "raster. Choose another `Projection`."));
    const auto [column, n_columns] =
      range(0, whole.west, whole.dx, whole.n_columns);
    const auto [row, n_rows] = range(1, whole.south, whole.dy, whole.n_rows);
    Raster result            = whole;
    result.west += column * whole.dx;
    result.south += row * whole.dy;
    result.n_columns = n_columns;
    result.n_rows    = n_rows;
    return result;
  }
} // namespace talus
