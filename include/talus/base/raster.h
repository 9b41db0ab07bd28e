// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_raster_h
#define talus_base_raster_h

#include <deal.II/base/point.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Numbers on a regular grid of rectangular map cells, with its position. A
  /// value belongs to the centre of a cell, not to a corner.
  struct Raster
  {
    unsigned int n_columns = 0; ///< from west to east
    unsigned int n_rows    = 0; ///< from north to south
    double       west      = 0; ///< outer edge of the first column, m
    double       south     = 0; ///< outer edge of the last row, m
    double       dx        = 1; ///< width of a cell, m
    double       dy        = 1; ///< height of a cell on the map, m
    /// Values row by row, from north to south, each row from west to east; NaN
    /// where no value exists.
    std::vector<double> values;
    /// Value written for NaN in a file.
    double nodata = -9999.;
    /// Coordinate reference system as well-known text or EPSG:NUMBER; empty if
    /// the file does not contain one.
    std::string coordinate_system;
    /// Unit of the values as the file states the unit; empty for m.
    std::string unit;
    /// Whether the values are heights on the map, m; otherwise another quantity
    /// in the unit of the file.
    bool has_heights = true;
    /// Width of the square over which values are means, m; 0 for values as the
    /// file has them.
    double smoothed_over = 0;

    /// Easting of the centre of a column, m.
    double
    x(const unsigned int column) const
    {
      return west + (column + 0.5) * dx;
    }

    /// Northing of the centre of a row, m.
    double
    y(const unsigned int row) const
    {
      return south + (n_rows - row - 0.5) * dy;
    }

    /// Outer edge of the last column, m.
    double
    east() const
    {
      return west + n_columns * dx;
    }

    /// Outer edge of the first row, m.
    double
    north() const
    {
      return south + n_rows * dy;
    }

    dealii::Point<2>
    middle() const
    {
      return {west + 0.5 * n_columns * dx, south + 0.5 * n_rows * dy};
    }

    double
    value(const unsigned int column, const unsigned int row) const
    {
      return values[std::size_t(row) * n_columns + column];
    }
  };



  /// Return the smallest and the largest of @p values, NaN left out.
  inline std::pair<double, double>
  range_of(const std::vector<double> &values)
  {
    constexpr double          inf = std::numeric_limits<double>::infinity();
    std::pair<double, double> range(inf, -inf);
    for (const double value : values)
      {
        range.first  = value < range.first ? value : range.first;
        range.second = value > range.second ? value : range.second;
      }
    return range;
  }



  /// Choice of the part of a raster that is read: a raster without values to a
  /// raster whose cells are some of its cells.
  using RasterPart = std::function<Raster(const Raster &)>;
} // namespace talus

#endif
