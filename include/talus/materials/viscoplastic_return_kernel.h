// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_viscoplastic_return_kernel_h
#define talus_materials_viscoplastic_return_kernel_h

#include <talus/base/simd_math.h>

#include <limits>
#include <type_traits>
#include <utility>

namespace talus
{
  /// Compute x^exponent for x > 0. Exponents that need only a root or a few
  /// multiplications are treated separately, which is faster and exact.
  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  power_of(const Number &x, const double exponent)
  {
    if (exponent == 0.5)
      return sqrt(x);
    if (exponent == 1.)
      return x;
    if (exponent == 2.)
      return x * x;
    if (exponent == 3.)
      return x * x * x;
    return pow(x, exponent);
  }



  /// Resistance to plastic shear in one step.
  template <typename Modulus, typename Decay = double>
  struct ShearResistanceOf
  {
    Modulus modulus;     ///< elastic shear modulus G, Pa
    double  consistency; ///< K >= 0, Pa s^n
    double  exponent;    ///< n > 0 [-]
    Decay   decay;       ///< rate of strength loss by remoulding, per plastic
                         ///< shear strain; 0: no remoulding
    double dt;           ///< time step, s
  };

  using ShearResistance = ShearResistanceOf<double>;



  /// Whether soil does not remould: never, if the rate differs from point to
  /// point.
  template <typename Decay>
  TALUS_ALWAYS_INLINE bool
  is_constant(const Decay &decay)
  {
    if constexpr (std::is_same_v<Decay, double>)
      return decay == 0.;
    else
      return false;
  }



  /// Find the root of an increasing convex function by Newton's method from
  /// @p x, at or above the root: the iterates fall towards the root with
  /// quadratic convergence. A lane stops and keeps its value after a step of
  /// less than 1e-8, or when round-off ends the fall, so its result does not
  /// depend on neighbouring lanes. @p function returns value and slope; only
  /// lanes in @p active change. A lane still active after 100 steps becomes NaN
  /// (among a million extreme cases no lane needed more than 32).
  template <typename Number, typename Mask, typename Function>
  TALUS_ALWAYS_INLINE Number
  newton_from_above(Number x, Mask active, const Function &function)
  {
    for (unsigned int i = 0; i < 100 && any(active); ++i)
      {
        const auto [value, slope] = function(x);
        const Number next         = x - value / slope;
        active &= next < x;
        const Mask more = active & (x - next > 1e-8 * x);
        x               = select(active, next, x);
        active          = more;
      }
    return select(active, Number(std::numeric_limits<double>::quiet_NaN()), x);
  }



  /// Shear stress taken up by a plastic shear @p x without viscosity, Pa, and
  /// its slope: @p linear x - loss (1 - exp(-decay x)).
  template <typename Number, typename Linear, typename Decay>
  TALUS_ALWAYS_INLINE std::pair<Number, Number>
                      stress_taken(const Number x,
                                   const Number loss,
                                   const Linear linear,
                                   const Decay  decay)
  {
    if (is_constant(decay))
      return {linear * x, Number(linear)};
    const Number change = loss * expm1(-1. * decay * x);
    return {linear * x + change, linear - decay * (loss + change)};
  }



  /// Upper bound of the shear at which stress_taken() equals @p excess, as the
  /// function is above its tangent at zero and above its asymptote.
  template <typename Number, typename Linear, typename Decay>
  TALUS_ALWAYS_INLINE Number
  max_shear(const Number excess,
            const Number loss,
            const Linear linear,
            const Decay  decay)
  {
    return min(excess / (linear - decay * loss),
               (excess + loss) * (1. / linear));
  }



  /// Solve plastic_shear() for the shear if n > 1 or if the viscous resistance
  /// is part of @p linear.
  template <typename Number, typename Mask, typename Modulus, typename Decay>
  TALUS_ALWAYS_INLINE Number
  solve_for_shear(const Number                             excess,
                  const Number                             loss,
                  const Mask                               yields,
                  const Modulus                            linear,
                  const ShearResistanceOf<Modulus, Decay> &r)
  {
    const bool is_power = (r.exponent > 1. && r.consistency > 0.);
    Number     start    = max_shear(excess, loss, linear, r.decay);
    if (is_power)
      start =
        min(start, r.dt * power_of(excess / r.consistency, 1. / r.exponent));
    return newton_from_above(start, yields, [&](const Number x) {
      auto [value, slope] = stress_taken(x, loss, linear, r.decay);
      if (is_power)
        {
          const Number viscous =
            r.consistency * power_of(x * (1. / r.dt), r.exponent);
          value += viscous;
          slope += r.exponent * viscous / x;
        }
      return std::make_pair(value - excess, slope);
    });
  }



  /// Solve plastic_shear() for the overstress y if n < 1.
  template <typename Number, typename Mask, typename Modulus, typename Decay>
  TALUS_ALWAYS_INLINE Number
  solve_for_overstress(const Number                             excess,
                       const Number                             loss,
                       const Mask                               yields,
                       const ShearResistanceOf<Modulus, Decay> &r)
  {
    const auto shear = [&](const Number y) {
      return r.dt * power_of(y * (1. / r.consistency), 1. / r.exponent);
    };
    const Number most = max_shear(excess, loss, r.modulus, r.decay);
    const Number start =
      min(excess, r.consistency * power_of(most * (1. / r.dt), r.exponent));
    return shear(newton_from_above(start, yields, [&](const Number y) {
      const Number x            = shear(y);
      const auto [value, slope] = stress_taken(x, loss, r.modulus, r.decay);
      return std::make_pair(value + (y - excess),
                            1. + slope * x / (r.exponent * y));
    }));
  }



  /// Plastic shear strain x of the step [-] by the backward Euler method: at
  /// the end of the step the shear stress equals the strength,
  ///   trial stress - G x = strength - loss (1 - exp(-decay x))
  ///                        + K (x/dt)^n.
  /// Zero if nothing is in excess, or if viscous material has no time to flow.
  ///
  /// The unknown is chosen so that the equation is convex and increasing: the
  /// shear for n >= 1, the overstress K (x/dt)^n for n < 1. The iteration
  /// starts from the smallest of the values allowed by each resistance alone.
  /// The start is above the root and, without remoulding, less than twice the
  /// root.
  /// @param excess Trial stress minus strength at the start of the step, Pa.
  /// @param loss Strength that further remoulding can remove, Pa; G > decay
  ///   loss.
  /// @param r Resistance to shear.
  template <typename Number, typename Modulus = double, typename Decay = double>
  TALUS_ALWAYS_INLINE Number
  plastic_shear(const Number                             excess,
                const Number                             loss,
                const ShearResistanceOf<Modulus, Decay> &r)
  {
    const auto yields     = (excess > Number(0.));
    const bool is_viscous = (r.consistency > 0.);
    if (!any(yields) || (is_viscous && r.dt == 0.))
      return Number(0.);

    const bool    is_linear = (!is_viscous || r.exponent == 1.);
    const Modulus linear =
      r.modulus + (is_linear && is_viscous ? r.consistency / r.dt : 0.);
    if (is_linear && is_constant(r.decay))
      return max(excess, Number(0.)) * Number(1. / linear);

    // Lanes without excess may have any positive number.
    const Number stress = select(yields, excess, Number(r.modulus));
    const Number x      = r.exponent < 1. && is_viscous
                            ? solve_for_overstress(stress, loss, yields, r)
                            : solve_for_shear(stress, loss, yields, linear, r);
    return select(yields, x, Number(0.));
  }
} // namespace talus

#endif
