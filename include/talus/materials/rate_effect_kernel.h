// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_effect_kernel_h
#define talus_materials_rate_effect_kernel_h

#include <talus/base/simd_math.h>
#include <talus/materials/rate_law_kernel.h>

#include <limits>
#include <utility>

namespace talus
{
  /// Effect of the rate of shearing on the strength: R = 1 + m asinh(x/x_r),
  /// with the plastic variable x of a step @cite einav2005.
  struct RateEffect
  {
    double coefficient; ///< m [-], 1/ln(10) of the gain per decade
    double reference;   ///< x_r [-], plastic variable of a step at the
                        ///< reference rate
  };



  /// Hyperbolic sine and cosine of @p z, accurate also for small @p z.
  template <typename Number>
  TALUS_ALWAYS_INLINE std::pair<Number, Number>
                      sinh_and_cosh(const Number z)
  {
    const Number grown  = expm1(z);             // e^z - 1
    const Number shrunk = grown / (grown + 1.); // 1 - e^-z
    return {0.5 * (grown + shrunk), 0.5 * (grown * shrunk) + 1.};
  }



  /// Find the root of @p function near @p x by Newton's method. @p function
  /// returns value and slope; only lanes in @p active change. A lane stops
  /// after a step of less than 1e-8, so its result does not depend on
  /// neighbouring lanes. A lane still active after 100 steps becomes NaN.
  template <typename Number, typename Mask, typename Function>
  TALUS_ALWAYS_INLINE Number
  newton(Number x, Mask active, const Function &function)
  {
    for (unsigned int i = 0; i < 100 && any(active); ++i)
      {
        const auto [value, slope] = function(x);
        const Number step         = value / slope;
        x                         = select(active, x - step, x);
        active &= step * step > 1e-16 * (x * x);
      }
    return select(active, Number(std::numeric_limits<double>::quiet_NaN()), x);
  }



  /// Plastic variable x of a step [-] by the backward Euler method: at the end
  /// of the step the stress equals the strength times R,
  ///   trial stress - modulus x = s(x) (1 + m asinh(x/x_r)).
  /// Zero if nothing is in excess, or in a step without time.
  ///
  /// With z = asinh(x/x_r), right side minus left side increases for all rates
  /// up to the rate of R_max if the softening s' satisfies
  ///   modulus > -s' (R_max + 2 m),
  /// and is convex except for a bend by less than 2 m |s'| x_r exp(-z), over
  /// which Newton's method loses at most half of the squared error. The
  /// iteration starts from the smaller of the values allowed by the elastic
  /// modulus alone and by the rate alone; both are above the root.
  /// @param excess Trial stress minus strength at the start of the step, Pa.
  /// @param curve Strength over x, see LinearSoftening: `strength` at the start
  ///   of the step, Pa; change(x), its change by x and the slope of the change,
  ///   Pa; the elastic `modulus`, Pa; at_rest(excess), an upper bound of x
  ///   without a rate effect.
  template <typename Number, typename Curve>
  TALUS_ALWAYS_INLINE Number
  plastic_increment(const Number      excess,
                    const Curve      &curve,
                    const RateEffect &rate)
  {
    const auto   yields = (excess > Number(0.));
    const double m = rate.coefficient, x_r = rate.reference;
    if (!any(yields) || x_r == 0.)
      return Number(0.);

    // Lanes without excess may have any positive number.
    const Number stress = select(yields, excess, Number(curve.modulus));
    const Number most   = curve.at_rest(stress);
    const Number lost   = min(curve.change(most).first, Number(0.));
    const Number least  = curve.strength + lost;
    const Number start  = min(log((2. / x_r) * most + 1.), // above asinh
                             (stress - lost) / (m * least));
    const Number z      = newton(start, yields, [&](const Number z) {
      const auto [sinh, cosh]    = sinh_and_cosh(z);
      const auto [change, slope] = curve.change(x_r * sinh);
      const Number R             = m * z + 1.;
      return std::make_pair(curve.modulus * (x_r * sinh) +
                              m * z * curve.strength + R * change - stress,
                            x_r * cosh * (curve.modulus + slope * R) +
                              m * (curve.strength + change));
    });
    return select(yields, x_r * sinh_and_cosh(z).first, Number(0.));
  }



  /// Radial return to the strength of @p FlowRule times the rate effect.
  /// FlowRule defines square_of_stress, the factor of s:s in the square of the
  /// stress measure, and curve(), see plastic_increment().
  template <typename FlowRule>
  struct RateDependentFlow
  {
    FlowRule   at_rest;
    RateEffect rate;

    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE Flow<Number>
                        operator()(const StressStep<dim, Number> &trial,
               const Number                  &softening,
               const PointStrength<Number>   &strength) const
    {
      const auto  &deviator = trial.deviator_after;
      const Number stress =
        sqrt(FlowRule::square_of_stress * contract(deviator, deviator) +
             std::numeric_limits<double>::min());
      const auto   curve = at_rest.curve(softening, strength);
      const Number increment =
        plastic_increment(Number(stress - curve.strength), curve, rate);
      return {curve.modulus * increment / stress, increment};
    }
  };

  template <typename FlowRule>
  inline constexpr bool is_iterative<RateDependentFlow<FlowRule>> = true;
} // namespace talus

#endif
