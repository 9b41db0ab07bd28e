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



  /// Columns of strength and stiffness by point.
  struct StrengthColumns
  {
    unsigned int factor; ///< strength factor, or invalid_unsigned_int
    /// Undrained shear strength, Pa, or invalid_unsigned_int; requires the
    /// column of the strength factor.
    unsigned int strength;
    bool         stiffness_follows; ///< moduli are proportional to the strength
  };



  /// Call action(factor) as with_strength_factor(), with a PointStrength if the
  /// strength differs from point to point.
  template <int dim, typename Action>
  inline void
  with_point_strength(const Points<dim>     &points,
                      const StrengthColumns &columns,
                      const Action          &action)
  {
    if (columns.strength == dealii::numbers::invalid_unsigned_int)
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
