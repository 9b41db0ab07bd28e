// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/height_field.h>

#include <talus/base/assertion.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Weights = std::array<double, 4>;



    /// Return the weights of four values along an axis at @p t between the
    /// second (0) and the third (1): Hermite's cubic with slopes by central
    /// differences.
    Weights
    weights(const double t)
    {
      const double s = 1. - t;
      return {{-0.5 * (s * s * t),
               s * s * (1. + 2. * t) - 0.5 * (-t * t * s),
               t * t * (3. - 2. * t) + 0.5 * (s * s * t),
               0.5 * (-t * t * s)}};
    }



    Weights
    weights_of_slope(const double t)
    {
      const double s = 1. - t, first = s * (1. - 3. * t),
                   last = t * (3. * t - 2.);
      return {{-0.5 * first,
               -6. * s * t - 0.5 * last,
               6. * s * t + 0.5 * first,
               0.5 * last}};
    }



    /// Return the weights of the control points of a Bezier curve, which is
    /// linear outside of 0 <= t <= 1.
    Weights
    bernstein(const double t)
    {
      const double s = 1. - t;
      if (t < 0.)
        return {{1. - 3. * t, 3. * t, 0., 0.}};
      if (s < 0.)
        return {{0., 0., 3. * s, 1. - 3. * s}};
      return {{s * s * s, 3. * s * s * t, 3. * s * t * t, t * t * t}};
    }



    Weights
    bernstein_of_slope(const double t)
    {
      const double u = std::clamp(t, 0., 1.), s = 1. - u;
      return {{-3. * s * s,
               3. * s * (s - 2. * u),
               3. * u * (2. * s - u),
               3. * u * u}};
    }
  } // namespace



  HeightField::HeightField(Raster raster)
    : raster_(std::move(raster))
    , bounds_{std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity(),
              0.}
  {
    TalusAssert(raster_.n_columns >= 2 && raster_.n_rows >= 2,
                ExcMessage("A surface needs two rows and columns."));
    for (unsigned int r = 0; r + 1 < raster_.n_rows; ++r)
      for (unsigned int c = 0; c + 1 < raster_.n_columns; ++c)
        extend_bounds(c, r);
  }



  /// Here @p row counts from the south: both axes ascend.
  bool
  HeightField::has_value(const int column, const int row) const
  {
    return column >= 0 && row >= 0 && column < int(raster_.n_columns) &&
           row < int(raster_.n_rows) && !std::isnan(value(column, row));
  }



  double
  HeightField::value(const int column, const int row) const
  {
    return raster_.value(column, raster_.n_rows - 1 - row);
  }



  /// Central difference if both neighbours along (dx, dy) have values,
  /// otherwise one-sided.
  double
  HeightField::difference(const int column,
                          const int row,
                          const int dx,
                          const int dy) const
  {
    const bool   before = has_value(column - dx, row - dy);
    const bool   after  = has_value(column + dx, row + dy);
    const double here   = value(column, row);
    const double left   = before ? value(column - dx, row - dy) : here;
    const double right  = after ? value(column + dx, row + dy) : here;
    return before && after ? 0.5 * (right - left) : right - left;
  }



  /// The mixed derivative is the difference along y of the differences along x.
  HeightField::Node
  HeightField::node(const int column, const int row) const
  {
    const double fx     = difference(column, row, 1, 0);
    const bool   before = has_value(column, row - 1);
    const bool   after  = has_value(column, row + 1);
    const double below  = before ? difference(column, row - 1, 1, 0) : fx;
    const double above  = after ? difference(column, row + 1, 1, 0) : fx;
    return {value(column, row),
            fx,
            difference(column, row, 0, 1),
            before && after ? 0.5 * (above - below) : above - below};
  }



  /// Return the control points of the Bezier form between the centres of four
  /// cells, of which the south-western one is given, row by row from the south;
  /// NaN if one of the four values is missing.
  HeightField::ControlPoints
  HeightField::control_points(const int column, const int row) const
  {
    ControlPoints p;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        {
          if (!has_value(column + i, row + j))
            {
              p.fill(std::numeric_limits<double>::quiet_NaN());
              return p;
            }
          const Node n  = node(column + i, row + j);
          const int  sx = (i == 0 ? 1 : -1), sy = (j == 0 ? 1 : -1);
          for (int k = 0; k < 2; ++k)
            for (int l = 0; l < 2; ++l)
              p[4 * (3 * j + l * sy) + 3 * i + k * sx] =
                n.f + (k * sx * n.fx + l * sy * n.fy) / 3. +
                k * l * sx * sy * n.fxy / 9.;
        }
    return p;
  }



  /// Heights are weighted means of the control points, and derivatives are
  /// weighted means of the differences of control points.
  void
  HeightField::extend_bounds(const int column, const int row)
  {
    const ControlPoints p = control_points(column, row);
    if (std::isnan(p[0]))
      return;
    double along_x = 0., along_y = 0.;
    for (int i = 0; i < 16; ++i)
      {
        bounds_.lowest  = std::min(bounds_.lowest, p[i]);
        bounds_.highest = std::max(bounds_.highest, p[i]);
        if (i % 4 < 3)
          along_x = std::max(along_x, std::abs(p[i + 1] - p[i]));
        if (i < 12)
          along_y = std::max(along_y, std::abs(p[i + 4] - p[i]));
      }
    bounds_.slope =
      std::max(bounds_.slope,
               3. * std::hypot(along_x / raster_.dx, along_y / raster_.dy));
  }



  namespace
  {
    /// Weights along an axis, for the value and for its derivative per cell.
    struct AxisWeights
    {
      Weights of_value, of_slope;
    };



    /// Return the sum of the products of weights and values, @p rows_apart in
    /// memory from one row to the row in the north, and the derivatives of the
    /// sum on cells of the size of @p raster. A missing value makes the height
    /// NaN.
    HeightField::Value
    weighted_sum(const double        *values,
                 const std::ptrdiff_t rows_apart,
                 const AxisWeights   &x,
                 const AxisWeights   &y,
                 const Raster        &raster)
    {
      double f = 0., fx = 0., fy = 0.;
      for (unsigned int l = 0; l < 4; ++l, values += rows_apart)
        {
          double sum = 0., slope = 0.;
          for (unsigned int k = 0; k < 4; ++k)
            {
              sum += x.of_value[k] * values[k];
              slope += x.of_slope[k] * values[k];
            }
          f += y.of_value[l] * sum;
          fx += y.of_value[l] * slope;
          fy += y.of_slope[l] * sum;
        }
      return {f, Point<2>(fx / raster.dx, fy / raster.dy)};
    }
  } // namespace



  std::optional<HeightField::Value>
  HeightField::at(const Point<2> &x, const Point<2> &origin) const
  {
    // Coordinates from the centre of the cell in the south-west, in cells. A
    // place on the edge is not refused because of round-off.
    const double u = (x[0] + (origin[0] - raster_.west)) / raster_.dx - 0.5;
    const double v = (x[1] + (origin[1] - raster_.south)) / raster_.dy - 0.5;
    constexpr double outer = -0.5 - 1e-6;
    const int        n_x = raster_.n_columns, n_y = raster_.n_rows;
    if (!(u >= outer && v >= outer && u <= n_x - 1 - outer &&
          v <= n_y - 1 - outer))
      return {};
    const int i = std::min(std::max(int(u), 0), n_x - 2);
    const int j = std::min(std::max(int(v), 0), n_y - 2);

    // Points near an obstacle evaluate the surface in every step: nearly
    // everywhere all sixteen values around the place exist.
    const double s = u - i, t = v - j;
    if (i > 0 && j > 0 && i < n_x - 2 && j < n_y - 2)
      if (const Value value =
            weighted_sum(&raster_.values[std::size_t(n_y - j) * n_x + i - 1],
                         -n_x,
                         {weights(s), weights_of_slope(s)},
                         {weights(t), weights_of_slope(t)},
                         raster_);
          !std::isnan(value.height))
        return value;
    const Value value = weighted_sum(control_points(i, j).data(),
                                     4,
                                     {bernstein(s), bernstein_of_slope(s)},
                                     {bernstein(t), bernstein_of_slope(t)},
                                     raster_);
    return std::isnan(value.height) ? std::optional<Value>() : value;
  }
} // namespace talus
