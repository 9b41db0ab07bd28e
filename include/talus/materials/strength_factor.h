// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_strength_factor_h
#define talus_materials_strength_factor_h

#include <talus/base/simd.h>
#include <talus/materials/point_strength_kernel.h>
#include <talus/points/points.h>

namespace talus
{
  /// The strength factor of points that have none: 1, at no cost.
  struct NoStrengthFactor
  {};

  template <typename Number>
  inline Number
  operator*(const Number &x, NoStrengthFactor)
  {
    return x;
  }



  /// factor(p, number) for points that have none.
  constexpr auto no_strength_factor = [](unsigned int, auto) {
    return NoStrengthFactor{};
  };



  /// Call action(factor) once, where factor(p, number) is what the strength of
  /// point(s) @p p is multiplied with [-]: the value in @p column, or
  /// NoStrengthFactor if that is invalid_unsigned_int. So the loop over points
  /// in @p action is compiled for both, and pays for the column only where
  /// there is one.
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



  /// Columns that say what is different from point to point, and how.
  struct StrengthColumns
  {
    unsigned int factor; ///< strength factor, or invalid_unsigned_int
    /// Undrained shear strength, Pa, or invalid_unsigned_int; if not, there is
    /// a strength factor, too.
    unsigned int strength;
    bool         stiffness_follows; ///< moduli are in proportion to it
  };



  /// The same with a PointStrength where the soil has another strength at each
  /// point.
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
