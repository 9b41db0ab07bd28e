// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_von_mises_kernel_h
#define talus_materials_von_mises_kernel_h

#include <talus/materials/rate_law_kernel.h>

#include <limits>
#include <utility>

namespace talus
{
  /// Strength as a function of the plastic variable of a step: the larger of a
  /// line and a constant. Stresses in Pa.
  template <typename Number>
  struct LinearSoftening
  {
    Number strength; ///< at the start of the step
    Number line;     ///< line minus strength at the start of the step, <= 0
    Number lowest;   ///< constant minus strength at the start of the step
    Number slope;    ///< slope of the line per plastic variable
    Number modulus;  ///< elastic stress per plastic variable

    /// Change of the strength by the plastic variable @p x, and its slope.
    TALUS_ALWAYS_INLINE std::pair<Number, Number>
                        change(const Number x) const
    {
      const Number on_line = line + slope * x;
      return {max(on_line, lowest),
              select(on_line > lowest, slope, Number(0.))};
    }

    /// Plastic variable that takes up @p excess at rest.
    TALUS_ALWAYS_INLINE Number
    at_rest(const Number excess) const
    {
      return min((excess - line) / (modulus + slope),
                 (excess - lowest) / modulus);
    }
  };



  /// Radial return of von Mises' law. The plastic variable is the equivalent
  /// plastic strain; the yield stress is linear in the softening down to the
  /// residual yield stress.
  struct VonMisesFlow
  {
    double mu;        ///< shear modulus, Pa
    double hardening; ///< slope of the yield stress over the softening, Pa
    double residual;  ///< residual yield stress, Pa
    /// Whether the yield stress reaches the residual one at a softening of 1,
    /// in place of `hardening`.
    bool ends_at_one = false;

    template <int dim, typename Number, typename Strength>
    TALUS_ALWAYS_INLINE Flow<Number>
                        operator()(const StressStep<dim, Number> &trial,
               const Strength                &softening,
               const PointStrength<Strength> &strength) const
    {
      const auto  &deviator = trial.deviator_after;
      const Number q        = sqrt(1.5 * contract(deviator, deviator) +
                            std::numeric_limits<double>::min());
      const Number d_ep     = plastic_increment(q, softening, strength);
      return {3. * (mu * strength.stiffness) * d_ep / q, d_ep};
    }

    /// Equivalent plastic strain that returns the trial stress @p q, Pa, to the
    /// yield stress; zero for elastic trials. The yield stress is the larger of
    /// a line and a constant, so the remainder of q is the smaller of two
    /// falling lines, with the smaller of their two roots. @p softening is the
    /// variable of the line.
    template <typename Number, typename Strength>
    TALUS_ALWAYS_INLINE Number
    plastic_increment(const Number                   q,
                      const Strength                &softening,
                      const PointStrength<Strength> &strength) const
    {
      const Strength compliance = 1. / (3. * mu) * strength.compliance;
      const Strength slope      = slope_of_line(strength);
      // A division only if the line has a slope.
      const Strength inverse =
        hardening == 0. && !ends_at_one
          ? compliance
          : Strength(1. / (3. * (mu * strength.stiffness) +
                           slope * strength.softening));
      const Number on_line =
        (q - initial(strength) - slope * softening) * inverse;
      const Number on_residual = (q - residual * strength.factor) * compliance;
      return max(min(on_line, on_residual), Number{});
    }

    /// Factor of s:s in the square of q.
    static constexpr double square_of_stress = 1.5;

    /// Yield stress over the equivalent plastic strain of a step, see
    /// plastic_increment() for rate effects.
    template <typename Number>
    TALUS_ALWAYS_INLINE LinearSoftening<Number>
    curve(const Number softening, const PointStrength<Number> &strength) const
    {
      const Number slope  = slope_of_line(strength);
      const Number line   = initial(strength) + slope * softening;
      const Number lowest = residual * strength.factor;
      const Number start  = max(line, lowest);
      return {start,
              line - start,
              lowest - start,
              slope * strength.softening,
              3. * (mu * strength.stiffness)};
    }

    /// Yield stress of undisturbed soil, Pa.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    initial(const PointStrength<Number> &strength) const
    {
      return 1.7320508075688772 * strength.undisturbed;
    }

    /// Slope of the yield stress before the residual one, Pa.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    slope_of_line(const PointStrength<Number> &strength) const
    {
      return ends_at_one ? residual * strength.factor - initial(strength)
                         : hardening * strength.factor;
    }
  };
} // namespace talus

#endif
