// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/height_field.h>
#include <talus/terrain/project_raster.h>

#include <deal.II/base/numbers.h>

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
    /// Of both axes at once, along which a cell of the raster is short.
    struct CellSize
    {
      double on_map;   ///< the smaller side, as the map has it, m
      double too_long; ///< the larger share by which the map is wrong [-]
    };



    /// At longitude and latitude @p x. True lengths are those on the ellipsoid of
    /// WGS 84, by its radii of curvature along the meridian and across
    /// (@cite snyder1987, eqs. 4-18, 4-20).
    CellSize
    cell_size(const Raster        &degrees,
              const MapProjection &projection,
              const Point<2>      &x)
    {
      constexpr double a = 6378137., e2 = 6.69437999014e-3;
      const double     radian = numbers::PI / 180.;
      const double     sine   = std::sin(x[1] * radian);
      const double     w      = 1. - e2 * sine * sine;
      const double     across = a / std::sqrt(w) * std::cos(x[1] * radian);
      const double     along  = a * (1. - e2) / (w * std::sqrt(w));
      CellSize         result{std::numeric_limits<double>::max(), 0.};
      for (const auto &[step, radius] :
           {std::pair<Tensor<1, 2>, double>(Point<2>(0.5 * degrees.dx, 0.),
                                            across),
            std::pair<Tensor<1, 2>, double>(Point<2>(0., 0.5 * degrees.dy),
                                            along)})
        {
          const double length =
            (projection.forward(x + step) - projection.forward(x - step))
              .norm();
          const double truth = 2. * step.norm() * radian * radius;
          result.on_map      = std::min(result.on_map, length);
          const double error = std::isfinite(length)
                                 ? std::abs(length / truth - 1.)
                                 : std::numeric_limits<double>::infinity();
          result.too_long    = std::max(result.too_long, error);
        }
      return result;
    }



    /// Corners of the cells along the edges, since these are bent on the map.
    std::vector<Point<2>>
    outline(const Raster &raster)
    {
      const double          east  = raster.west + raster.n_columns * raster.dx;
      const double          north = raster.south + raster.n_rows * raster.dy;
      std::vector<Point<2>> result;
      for (unsigned int i = 0; i <= raster.n_columns; ++i)
        for (const double y : {raster.south, north})
          result.emplace_back(raster.west + i * raster.dx, y);
      for (unsigned int i = 0; i <= raster.n_rows; ++i)
        for (const double x : {raster.west, east})
          result.emplace_back(x, raster.south + i * raster.dy);
      return result;
    }



    Point<2>
    middle(const Raster &raster)
    {
      return {raster.west + 0.5 * raster.n_columns * raster.dx,
              raster.south + 0.5 * raster.n_rows * raster.dy};
    }



    void
    check_scale(const Raster         &degrees,
                const MapProjection  &projection,
                std::vector<Point<2>> places,
                const std::string    &place)
    {
      const Point<2> centre = middle(degrees);
      places.push_back(centre);
      for (const Point<2> &x : places)
        {
          const double error = cell_size(degrees, projection, x).too_long;
          AssertThrow(error <= 0.01,
                      ExcUser(text(place,
                                   " projects a raster whose lengths would be "
                                   "wrong by ",
                                   100. * error,
                                   " % at longitude ",
                                   x[0],
                                   ", latitude ",
                                   x[1],
                                   ", where at most 1 % was expected. Choose "
                                   "another map (in its middle the raster is "
                                   "in the zone ",
                                   utm_zone(centre[0], centre[1]).name(),
                                   "), or cut out the part you need.")));
        }
    }



    /// Cells of this size that cover the outline, without values.
    Raster
    frame(const std::vector<Point<2>> &outline,
          const MapProjection         &projection,
          const double                 spacing,
          const std::string           &place)
    {
      Point<2> lower = projection.forward(outline.front()), upper = lower;
      for (const Point<2> &x : outline)
        {
          const Point<2> corner = projection.forward(x);
          for (unsigned int d = 0; d < 2; ++d)
            {
              lower[d] = std::min(lower[d], corner[d]);
              upper[d] = std::max(upper[d], corner[d]);
            }
        }
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



  // Backwards, from each centre of the new cells to the old ones: so values are
  // interpolated in the raster's own lattice, and half a cell is half a cell.
  Raster
  project_raster(Raster               degrees,
                 const MapProjection &projection,
                 const double         spacing,
                 const std::string   &place)
  {
    const auto     edge   = outline(degrees);
    const Point<2> centre = middle(degrees);
    check_scale(degrees, projection, edge, place);
    const double own = cell_size(degrees, projection, centre).on_map;
    Raster result = frame(edge, projection, spacing > 0 ? spacing : own, place);
    result.nodata = degrees.nodata;
    const HeightField heights(std::move(degrees));
    result.values.reserve(std::size_t(result.n_rows) * result.n_columns);
    for (unsigned int r = 0; r < result.n_rows; ++r)
      for (unsigned int i = 0; i < result.n_columns; ++i)
        {
          Point<2> x = projection.inverse(Point<2>(result.x(i), result.y(r)));
          // A raster may count its longitudes from 0 to 360.
          x[0] += 360. * std::round((centre[0] - x[0]) / 360.);
          const auto value = heights.at(x);
          result.values.push_back(
            value ? value->height : std::numeric_limits<double>::quiet_NaN());
        }
    return result;
  }
} // namespace talus
