// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_height_field_h
#define talus_geometry_height_field_h

#include <talus/base/raster.h>

#include <deal.II/base/point.h>

#include <optional>

namespace talus
{
  /// The surface through the values of a raster, with continuous slopes:
  /// between the centres of the cells it is cubic along each axis, with the
  /// slopes of central differences (Catmull and Rom's splines). A bilinear one
  /// has kinks, and soil that slides over a kink meets an impact. Beside the
  /// edge of the raster, and beside cells without data, differences are
  /// one-sided, so that planes are exact everywhere; over the outer half of the
  /// outermost cells the surface goes on straight.
  class HeightField
  {
  public:
    struct Value
    {
      double               height; ///< m
      dealii::Tensor<1, 2> slope;  ///< along easting and northing [-]
    };

    /// What bounds the surface.
    struct Bounds
    {
      double lowest, highest; ///< m
      double slope;           ///< largest [-]
    };

    /// At least two rows and columns.
    explicit HeightField(Raster raster);

    /// At easting and northing @p x, m, counted from @p origin, so that large
    /// coordinates lose no digits; nothing outside of the raster, and where one
    /// of the four values around the place is missing.
    std::optional<Value>
    at(const dealii::Point<2> &x,
       const dealii::Point<2> &origin = dealii::Point<2>()) const;

    /// Of all of the surface; not the closest ones.
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

    bool
    has_value(int column, int row) const;
    double
    value(int column, int row) const;
    double
    difference(int column, int row, int dx, int dy) const;
    Node
    node(int column, int row) const;
    Value
    inner_value(int column, int row, double u, double v, bool &is_known) const;
    Value
    outer_value(int column, int row, double u, double v, bool &is_known) const;
    void
    extend_bounds(int column, int row);

    Raster raster_;
    Bounds bounds_;
  };
} // namespace talus

#endif
