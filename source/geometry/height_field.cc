// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/height_field.h>

#include <talus/base/assertion.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Weights of the values and slopes at both ends of an interval, for the
    /// value or the derivative in the interval.
    struct Hermite
    {
      std::array<double, 2> value, slope;
    };



    /// Hermite's cubic for 0 <= t <= 1, linear outside.
    Hermite
    hermite(const double t)
    {
      if (t < 0.)
        return {{{1., 0.}}, {{t, 0.}}};
      if (t > 1.)
        return {{{0., 1.}}, {{0., t - 1.}}};
      const double s = 1. - t;
      return {{{s * s * (1. + 2. * t), t * t * (3. - 2. * t)}},
              {{s * s * t, -t * t * s}}};
    }



    Hermite
    hermite_derivative(const double t)
    {
      if (t < 0.)
        return {{{0., 0.}}, {{1., 0.}}};
      if (t > 1.)
        return {{{0., 0.}}, {{0., 1.}}};
      const double s = 1. - t;
      return {{{-6. * s * t, 6. * s * t}},
              {{s * (1. - 3. * t), t * (3. * t - 2.)}}};
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



  /// Bounds by the control points of the Bezier form: heights are weighted
  /// means of the control points, and derivatives are weighted means of the
  /// differences of control points.
  void
  HeightField::extend_bounds(const int column, const int row)
  {
    std::array<std::array<double, 4>, 4> p; // by x, then y
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        {
          if (!has_value(column + i, row + j))
            return;
          const Node n  = node(column + i, row + j);
          const int  sx = (i == 0 ? 1 : -1), sy = (j == 0 ? 1 : -1);
          for (int k = 0; k < 2; ++k)
            for (int l = 0; l < 2; ++l)
              p[3 * i + k * sx][3 * j + l * sy] =
                n.f + (k * sx * n.fx + l * sy * n.fy) / 3. +
                k * l * sx * sy * n.fxy / 9.;
        }
    double along_x = 0., along_y = 0.;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        {
          bounds_.lowest  = std::min(bounds_.lowest, p[i][j]);
          bounds_.highest = std::max(bounds_.highest, p[i][j]);
          if (i < 3)
            along_x = std::max(along_x, std::abs(p[i + 1][j] - p[i][j]));
          if (j < 3)
            along_y = std::max(along_y, std::abs(p[i][j + 1] - p[i][j]));
        }
    bounds_.slope =
      std::max(bounds_.slope,
               3. * std::hypot(along_x / raster_.dx, along_y / raster_.dy));
  }



  namespace
  {
    /// Return the weights of the four values along an axis: Hermite's cubic
    /// with slopes by central differences.
    std::array<double, 4>
    weights(const Hermite &h)
    {
      return {{-0.5 * h.slope[0],
               h.value[0] - 0.5 * h.slope[1],
               h.value[1] + 0.5 * h.slope[0],
               0.5 * h.slope[1]}};
    }
  } // namespace



  /// Fast path, valid nearly everywhere: all sixteen values around the place
  /// exist. Points near an obstacle evaluate the surface in every step. A
  /// missing value makes the sum NaN.
  HeightField::Value
  HeightField::inner_value(const int    column,
                           const int    row,
                           const double u,
                           const double v,
                           bool        &is_known) const
  {
    const auto x       = weights(hermite(u)),
               along_x = weights(hermite_derivative(u));
    const auto y       = weights(hermite(v)),
               along_y = weights(hermite_derivative(v));
    double        f = 0., fx = 0., fy = 0.;
    const double *from =
      &raster_.values[std::size_t(raster_.n_rows - row) * raster_.n_columns +
                      column - 1];
    for (unsigned int l = 0; l < 4; ++l, from -= raster_.n_columns)
      {
        double sum = 0., slope = 0.;
        for (unsigned int k = 0; k < 4; ++k)
          {
            sum += x[k] * from[k];
            slope += along_x[k] * from[k];
          }
        f += y[l] * sum;
        fx += y[l] * slope;
        fy += along_y[l] * sum;
      }
    is_known = !std::isnan(f);
    return {f, Point<2>(fx / raster_.dx, fy / raster_.dy)};
  }



  /// General path, node by node.
  HeightField::Value
  HeightField::outer_value(const int    column,
                           const int    row,
                           const double u,
                           const double v,
                           bool        &is_known) const
  {
    const Hermite x = hermite(u), along_x = hermite_derivative(u);
    const Hermite y = hermite(v), along_y = hermite_derivative(v);
    Value         result{0., {}};
    is_known = true;
    for (int l = 0; l < 2; ++l)
      for (int k = 0; k < 2; ++k)
        {
          is_known = is_known && has_value(column + k, row + l);
          if (!is_known)
            return result;
          const Node n   = node(column + k, row + l);
          const auto add = [&](const Hermite &a, const Hermite &b) {
            return a.value[k] * (b.value[l] * n.f + b.slope[l] * n.fy) +
                   a.slope[k] * (b.value[l] * n.fx + b.slope[l] * n.fxy);
          };
          result.height += add(x, y);
          result.slope[0] += add(along_x, y) / raster_.dx;
          result.slope[1] += add(x, along_y) / raster_.dy;
        }
    return result;
  }



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

    bool is_known = false;
    if (i > 0 && j > 0 && i < n_x - 2 && j < n_y - 2)
      if (const Value value = inner_value(i, j, u - i, v - j, is_known);
          is_known)
        return value;
    const Value value = outer_value(i, j, u - i, v - j, is_known);
    return is_known ? value : std::optional<Value>();
  }
} // namespace talus
