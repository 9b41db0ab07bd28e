// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_height_field_h
#define talus_geometry_height_field_h

#include <talus/base/raster.h>

#include <deal.II/base/point.h>

#include <array>
#include <optional>

namespace talus
{
  /// Surface through the values of a raster, with continuous slopes: between
  /// the centres of the cells cubic along each axis, with slopes by central
  /// differences (Catmull-Rom splines). A bilinear surface has kinks, and soil
  /// sliding over a kink meets an impact. At the edge of the raster, and beside
  /// cells without data, differences are one-sided: planes are exact
  /// everywhere. Over the outer half of the outermost cells the surface is
  /// extended linearly.
  class HeightField
  {
  public:
    struct Value
    {
      double               height; ///< m
      dealii::Tensor<1, 2> slope;  ///< along easting and northing [-]
    };

    /// Bounds of height and slope.
    struct Bounds
    {
      double lowest, highest; ///< m
      double slope;           ///< largest [-]
    };

    /// @p raster has at least two rows and columns.
    explicit HeightField(Raster raster);

    /// Return height and slope at easting and northing @p x, m, relative to
    /// @p origin (large coordinates lose no digits). Nothing outside of the
    /// raster, and where any of the four values around the place is missing.
    std::optional<Value>
    at(const dealii::Point<2> &x,
       const dealii::Point<2> &origin = dealii::Point<2>()) const;

    /// Return bounds of the whole surface, not necessarily the closest bounds.
    const Bounds &
    bounds() const
    {
      return bounds_;
    }

    const Raster &
    raster() const
    {
      return raster_;
    }

  private:
    /// Height and derivatives at the centre of a cell, per cell, not per metre.
    struct Node
    {
      double f, fx, fy, fxy;
    };

    using ControlPoints = std::array<double, 16>;

    bool
    has_value(int column, int row) const;
    double
    value(int column, int row) const;
    double
    difference(int column, int row, int dx, int dy) const;
    Node
    node(int column, int row) const;
    ControlPoints
    control_points(int column, int row) const;
    void
    extend_bounds(int column, int row);

    Raster raster_;
    Bounds bounds_;
  };
} // namespace talus

#endif
