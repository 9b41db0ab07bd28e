// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_raster_h
#define talus_base_raster_h

#include <limits>
#include <string>
#include <vector>

namespace talus
{
  /// Numbers on a regular lattice of cells of a map, with where it lies. A value
  /// belongs to the centre of its cell, not to a corner.
  struct Raster
  {
    unsigned int n_columns = 0; ///< from west to east
    unsigned int n_rows    = 0; ///< from north to south
    double       west      = 0; ///< outer edge of the first column, m
    double       south     = 0; ///< outer edge of the last row, m
    double       dx        = 1; ///< width of a cell, m
    double       dy        = 1; ///< its height on the map, m
    /// Row by row, the northernmost first, each from west to east; NaN where
    /// there is no datum.
    std::vector<double> values;
    /// What stands for NaN in a file.
    double nodata = -9999.;
    /// The map that it lies on, as well-known text or EPSG:NUMBER; empty if the
    /// file does not say it.
    std::string coordinate_system;

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

    double
    value(const unsigned int column, const unsigned int row) const
    {
      return values[std::size_t(row) * n_columns + column];
    }
  };
} // namespace talus

#endif
