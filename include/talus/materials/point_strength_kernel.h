// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_point_strength_kernel_h
#define talus_materials_point_strength_kernel_h

#include <talus/base/simd.h>
#include <talus/materials/moduli.h>

namespace talus
{
  /// Strength and stiffness of soil at one point, or of several points at once.
  template <typename Number>
  struct PointStrength
  {
    Number undisturbed; ///< undrained shear strength times `factor`, Pa
    Number factor;      ///< strength factor [-]
    Number stiffness;   ///< moduli of the point over the moduli of the law [-]
    Number compliance;  ///< inverse of `stiffness` [-]
    Number softening;   ///< softening per plastic variable [-]
  };



  /// Values at the points: a column, or one number for all points.
  struct ColumnOrNumber
  {
    const double *column = nullptr;
    double        number = 1.;

    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    at(const unsigned int p) const
    {
      return column == nullptr ? Number(number) : load<Number>(column + p);
    }
  };



  /// Function strength(p, number) for the PointStrength of point(s) p.
  struct StrengthOfPoints
  {
    ColumnOrNumber strength = {nullptr, 0.}; ///< undrained shear strength, Pa;
                                             ///< 0 if the law has none
    ColumnOrNumber factor         = {};      ///< strength factor [-]
    ColumnOrNumber stiffness      = {};      ///< as in PointStrength
    ColumnOrNumber cell_size      = {};      ///< m; 1 if not used
    double         softening_rate = 1.; ///< softening over plastic variable and
                                        ///< cell size, 1/m
    /// Column of the softening [-], on which the strength depends: the plastic
    /// variable, or the displacement across a shear band as wide as the cell
    /// over the softening displacement. Invalid in elastic laws.
    unsigned int softening_column = -1;

    template <typename Number>
    TALUS_ALWAYS_INLINE PointStrength<Number>
    operator()(const unsigned int p, const Number & /*number*/) const
    {
      const Number share = factor.at<Number>(p);
      // A division only where points differ.
      const Number ratio = stiffness.at<Number>(p);
      return {share * strength.at<Number>(p),
              share,
              ratio,
              stiffness.column == nullptr ? ratio : Number(1. / ratio),
              softening_rate * cell_size.at<Number>(p)};
    }
  };



  /// Moduli of the point(s), Pa, from the @p moduli of the law.
  template <typename Number>
  TALUS_ALWAYS_INLINE ModuliOf<Number>
  moduli_of_point(const Moduli &moduli, const PointStrength<Number> &strength)
  {
    return {moduli.lambda * strength.stiffness,
            moduli.mu * strength.stiffness,
            moduli.bulk * strength.stiffness};
  }
} // namespace talus

#endif
