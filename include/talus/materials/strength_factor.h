// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_strength_factor_h
#define talus_materials_strength_factor_h

#include <talus/base/simd.h>
#include <talus/materials/point_strength_kernel.h>
#include <talus/points/points.h>

namespace talus
{
  /// Strength factor 1 of points without the column, at no cost.
  struct NoStrengthFactor
  {};

  template <typename Number>
  inline Number
  operator*(const Number &x, NoStrengthFactor)
  {
    return x;
  }



  /// Function factor(p, number) for points without the column.
  constexpr auto no_strength_factor = [](unsigned int, auto) {
    return NoStrengthFactor{};
  };



  /// Call action(factor) once with a function factor(p, number), which returns
  /// the strength factor of point(s) @p p [-]: the value in @p column, or
  /// NoStrengthFactor if @p column is invalid_unsigned_int. The loop over
  /// points in @p action is compiled for both types, so points without the
  /// column pay nothing.
  template <int dim, typename Action>
  inline void
  with_strength_factor(const Points<dim> &points,
                       const unsigned int column,
                       const Action      &action)
  {
    if (column == dealii::numbers::invalid_unsigned_int)
      action(no_strength_factor);
    else
      action(
        [factor = points.data(column)](const unsigned int p, auto number)
          TALUS_INLINE_LAMBDA { return load<decltype(number)>(factor + p); });
  }



  /// Columns of soil that softens with the displacement across a shear band as
  /// wide as the cell of the point.
  struct BandColumns
  {
    /// Displacement across the band over the softening displacement [-], or
    /// invalid_unsigned_int.
    unsigned int softening = dealii::numbers::invalid_unsigned_int;
    unsigned int cell_size = dealii::numbers::invalid_unsigned_int; ///< m
    /// Softening over plastic variable and cell size, 1/m.
    double rate = 0.;
  };

  /// Columns of strength and stiffness by point.
  struct StrengthColumns
  {
    unsigned int factor; ///< strength factor, or invalid_unsigned_int
    /// Undrained shear strength, Pa, or invalid_unsigned_int; requires the
    /// column of the strength factor.
    unsigned int strength;
    bool         stiffness_follows; ///< moduli are proportional to the strength
    BandColumns  band = {};
  };



  /// Return a function factor(p, number) for the BandStrength of point(s) p.
  template <int dim>
  inline auto
  band_strength(const Points<dim> &points, const StrengthColumns &columns)
  {
    const auto data = [&](const unsigned int column) -> const double * {
      return column == dealii::numbers::invalid_unsigned_int
               ? nullptr
               : points.data(column);
    };
    return [factor    = data(columns.factor),
            strength  = data(columns.strength),
            follows   = columns.stiffness_follows,
            cell_size = points.data(columns.band.cell_size),
            rate      = columns.band.rate](const unsigned int p,
                                      auto number) TALUS_INLINE_LAMBDA {
      using Number      = decltype(number);
      const auto one_or = [&](const double *const values) {
        return values == nullptr ? Number(1.) : load<Number>(values + p);
      };
      const Number s = one_or(strength);
      return BandStrength<Number>{{one_or(factor), s, follows ? s : Number(1.)},
                                  rate * load<Number>(cell_size + p)};
    };
  }



  /// Call action(factor) as with_strength_factor(), with a PointStrength if the
  /// strength differs from point to point, with a BandStrength if it falls with
  /// the displacement across a band.
  template <int dim, typename Action>
  inline void
  with_point_strength(const Points<dim>     &points,
                      const StrengthColumns &columns,
                      const Action          &action)
  {
    if (columns.band.softening != dealii::numbers::invalid_unsigned_int)
      action(band_strength(points, columns));
    else if (columns.strength == dealii::numbers::invalid_unsigned_int)
      with_strength_factor(points, columns.factor, action);
    else
      action(
        [factor   = points.data(columns.factor),
         strength = points.data(columns.strength),
         follows = columns.stiffness_follows](const unsigned int p, auto number)
          TALUS_INLINE_LAMBDA {
            using Number   = decltype(number);
            const Number s = load<Number>(strength + p);
            return PointStrength<Number>{load<Number>(factor + p),
                                         s,
                                         follows ? s : Number(1.)};
          });
  }
} // namespace talus

#endif
