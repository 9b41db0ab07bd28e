// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_viscoplastic_return_kernel_h
#define talus_materials_viscoplastic_return_kernel_h

#include <talus/base/simd_math.h>

#include <limits>
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
  template <typename Modulus>
  struct ShearResistanceOf
  {
    Modulus modulus;     ///< elastic shear modulus G, Pa
    double  consistency; ///< K >= 0, Pa s^n
    double  exponent;    ///< n > 0 [-]
    Modulus decay;       ///< rate of strength loss by remoulding, per plastic
                         ///< shear strain; 0: no remoulding
    double dt;           ///< time step, s
  };

  using ShearResistance = ShearResistanceOf<double>;



  /// Whether no point remoulds, which saves the exponentials.
  template <typename Decay>
  TALUS_ALWAYS_INLINE bool
  is_constant(const Decay &decay)
  {
    return !any(decay > Decay(0.));
  }



  /// Value of a function of x, and its derivatives times x and x^2.
  template <typename Number>
  struct ScaledDerivatives
  {
    Number value, first, second;
  };



  /// Step of Halley's method towards the root of @p f, over x: the root is near
  /// x (1 - step). Convergence is cubic. For increasing convex functions that
  /// are sums of powers, from above the root, the step is less than 1.
  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  halley_step(const ScaledDerivatives<Number> &f)
  {
    return f.value * f.first / (f.first * f.first - 0.5 * f.value * f.second);
  }



  /// Repeat @p iterate(active), which improves the lanes in the mask @p active
  /// and returns their last relative steps, until the steps are less than 1e-5.
  /// A lane then stops, so its result does not depend on neighbouring lanes.
  /// Returns the lanes still active after 100 steps.
  template <typename Mask, typename Iterate>
  TALUS_ALWAYS_INLINE Mask
  until_converged(Mask active, const Iterate &iterate)
  {
    for (unsigned int i = 0; i < 100 && any(active); ++i)
      {
        const auto step = iterate(active);
        active &= step * step > 1e-10;
      }
    return active;
  }



  /// Shear stress taken up by a plastic shear @p x without viscosity, Pa, and
  /// its slope: @p linear x - loss (1 - exp(-decay x)).
  template <typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE std::pair<Number, Number>
                      stress_taken(const Number  x,
                                   const Number  loss,
                                   const Modulus linear,
                                   const Modulus decay)
  {
    if (is_constant(decay))
      return {linear * x, Number(linear)};
    const Number change = loss * expm1(-1. * decay * x);
    return {linear * x + change, linear - decay * (loss + change)};
  }



  /// Upper bound of the shear at which stress_taken() equals @p excess, as the
  /// function is above its tangent at zero and above its asymptote.
  template <typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE Number
  max_shear(const Number  excess,
            const Number  loss,
            const Modulus linear,
            const Modulus decay)
  {
    return min(excess / (linear - decay * loss),
               (excess + loss) * (1. / linear));
  }



  /// Solve plastic_shear() for the shear if n > 1 or if the viscous resistance
  /// is part of @p linear.
  template <typename Number, typename Mask, typename Modulus>
  TALUS_ALWAYS_INLINE Number
  solve_for_shear(const Number                      excess,
                  const Number                      loss,
                  const Mask                        yields,
                  const Modulus                     linear,
                  const ShearResistanceOf<Modulus> &r)
  {
    const bool is_power = (r.exponent > 1. && r.consistency > 0.);
    Number     start    = max_shear(excess, loss, linear, r.decay);
    if (is_power)
      start =
        min(start, r.dt * power_of(excess / r.consistency, 1. / r.exponent));
    const auto resistance = [&](const Number x) {
      const auto [value, slope]   = stress_taken(x, loss, linear, r.decay);
      ScaledDerivatives<Number> f = {value - excess,
                                     slope * x,
                                     (linear - slope) * r.decay * x * x};
      if (is_power)
        {
          const double n       = r.exponent;
          const Number viscous = r.consistency * power_of(x * (1. / r.dt), n);
          f.value += viscous;
          f.first += n * viscous;
          f.second += n * (n - 1.) * viscous;
        }
      return f;
    };
    Number     x      = start;
    const auto failed = until_converged(yields, [&](const Mask active) {
      const Number step = halley_step(resistance(x));
      x                 = select(active, x - step * x, x);
      return step;
    });
    return select(failed, Number(std::numeric_limits<double>::quiet_NaN()), x);
  }



  /// Solve plastic_shear() for the overstress y if n < 1; x is the shear.
  template <typename Number, typename Mask, typename Modulus>
  TALUS_ALWAYS_INLINE Number
  solve_for_overstress(const Number                      excess,
                       const Number                      loss,
                       const Mask                        yields,
                       const ShearResistanceOf<Modulus> &r)
  {
    const double q          = 1. / r.exponent;
    const auto   resistance = [&](const Number x, const Number y) {
      const auto [value, slope] = stress_taken(x, loss, r.modulus, r.decay);
      const Number qx           = q * x;
      return ScaledDerivatives<Number>{
        value + (y - excess),
        slope * qx + y,
        qx * ((r.modulus - slope) * r.decay * qx + (q - 1.) * slope)};
    };

    // The upper bounds of the elastic resistance alone and of the viscous one
    // alone. The first step starts from the elastic one, the shear of which is
    // known without a power.
    Number       x = max_shear(excess, loss, r.modulus, r.decay);
    const Number elastic =
      r.consistency * power_of(x * (1. / r.dt), r.exponent);
    const Number first =
      elastic - elastic * halley_step(resistance(x, elastic));
    Number y = min(excess, select(first > 0., first, elastic));

    Number     last   = 0.;
    const auto failed = until_converged(yields, [&](const Mask active) {
      x    = select(active, r.dt * power_of(y * (1. / r.consistency), q), x);
      last = select(active, halley_step(resistance(x, y)), last);
      y    = select(active, y - last * y, y);
      return last;
    });
    // The last step of y changes x as (1 - last)^q.
    x = x - q * last * x * (1. - 0.5 * (q - 1.) * last);
    return select(failed, Number(std::numeric_limits<double>::quiet_NaN()), x);
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
  template <typename Number, typename Modulus = double>
  TALUS_ALWAYS_INLINE Number
  plastic_shear(const Number                      excess,
                const Number                      loss,
                const ShearResistanceOf<Modulus> &r)
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
