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
  template <typename Number, typename Modulus, typename Slope>
  struct LinearSoftening
  {
    Number  strength; ///< at the start of the step
    Number  line;     ///< line minus strength at the start of the step, <= 0
    Number  lowest;   ///< constant minus strength at the start of the step
    Slope   slope;    ///< slope of the line per plastic variable
    Modulus modulus;  ///< elastic stress per plastic variable

    /// Change of the strength by the plastic variable @p x, and its slope.
    TALUS_ALWAYS_INLINE std::pair<Number, Number>
                        change(const Number x) const
    {
      const Number on_line = line + slope * x;
      return {max(on_line, lowest),
              select(on_line > lowest, Number(slope), Number(0.))};
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
  /// plastic strain; the yield stress is linear in it down to the residual
  /// yield stress, or, under a BandStrength, linear in the softening, from the
  /// initial yield stress at 0 to the residual one at 1.
  struct VonMisesFlow
  {
    double mu;        ///< shear modulus, Pa
    double initial;   ///< yield stress, Pa; with PointStrength of 1 Pa strength
    double hardening; ///< slope of the yield stress, Pa; not with BandStrength
    double residual;  ///< residual yield stress, Pa

    template <int dim, typename Number, typename Variable, typename Factor>
    TALUS_ALWAYS_INLINE Flow<Number>
                        operator()(const StressStep<dim, Number> &trial,
               const Variable                &softening,
               const Factor                  &strength_factor) const
    {
      const auto  &deviator = trial.deviator_after;
      const Number q        = sqrt(1.5 * contract(deviator, deviator) +
                            std::numeric_limits<double>::min());
      const Number d_ep =
        plastic_increment(q, Number(softening), strength_factor);
      return {3. * modulus_of_point(mu, strength_factor) * d_ep / q, d_ep};
    }

    /// Equivalent plastic strain that returns the trial stress @p q, Pa, to the
    /// yield stress; zero for elastic trials. The yield stress is the larger of
    /// a line and a constant, so the remainder of q is the smaller of two
    /// falling lines, with the smaller of their two roots. All strengths are
    /// multiplied by @p factor. @p softening is the variable of the line.
    template <typename Number, typename Factor>
    TALUS_ALWAYS_INLINE Number
    plastic_increment(const Number  q,
                      const Number  softening,
                      const Factor &factor) const
    {
      const auto   modulus = modulus_of_point(mu, factor);
      const auto   given   = share_of_given_strength(factor);
      const auto   slope   = slope_of_line(factor);
      const Number on_line =
        (q - initial * share_of_strength(factor) - slope * softening) *
        (1. / (3. * modulus + slope_of_point(slope, factor)));
      const Number on_residual = (q - residual * given) * (1. / (3. * modulus));
      return max(min(on_line, on_residual), Number{});
    }

    /// Factor of s:s in the square of q.
    static constexpr double square_of_stress = 1.5;

    /// Yield stress over the equivalent plastic strain of a step, see
    /// plastic_increment() for rate effects.
    template <typename Number, typename Factor>
    TALUS_ALWAYS_INLINE auto
    curve(const Number softening, const Factor &factor) const
    {
      auto         modulus = 3. * modulus_of_point(mu, factor);
      auto         slope   = slope_of_point(slope_of_line(factor), factor);
      const Number line    = initial * share_of_strength(factor) +
                          Number(slope_of_line(factor)) * softening;
      const Number lowest = Number(residual) * share_of_given_strength(factor);
      const Number strength = max(line, lowest);
      return LinearSoftening<Number, decltype(modulus), decltype(slope)>{
        strength, line - strength, lowest - strength, slope, modulus};
    }

    /// Slope of the yield stress before the residual one, Pa.
    template <typename Factor>
    TALUS_ALWAYS_INLINE auto
    slope_of_line(const Factor &factor) const
    {
      if constexpr (is_band_strength<Factor>)
        return residual * share_of_given_strength(factor) -
               initial * share_of_strength(factor);
      else
        return hardening * share_of_given_strength(factor);
    }
  };
} // namespace talus

#endif
