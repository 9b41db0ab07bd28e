// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_cam_clay_kernel_h
#define talus_materials_cam_clay_kernel_h

#include <talus/base/dual.h>
#include <talus/materials/mohr_coulomb_kernel.h>
#include <talus/materials/viscoplastic_return_kernel.h>

#include <limits>

namespace talus
{
  /// Return to the yield surface of modified Cam clay as one equation for the
  /// plastic compression x of the step [-], with mean effective stress p and
  /// preconsolidation pressure p_c, Pa, compression positive:
  ///   f(x) = (w q/M)^2 + p (p - p_c) = 0,  p = p_trial exp(-a x),
  ///   p_c = p_c0 exp(b x),  w = (2 p - p_c)/(2 p - p_c + 6 G/M^2 x).
  /// w is the share of the deviator that is left. The plastic multiplier
  /// x/(2 p - p_c) is eliminated, which leaves no sign to choose: the root lies
  /// between x = 0 and the critical state 2 p = p_c, where f < 0, on the side
  /// of compression and on that of dilation.
  template <typename Number>
  struct CamClayReturn
  {
    Number pressure;         ///< p at the end of an elastic step, Pa
    Number preconsolidation; ///< p_c at the start, Pa
    Number shear;            ///< q/M of the trial stress, Pa
    Number shear_modulus;    ///< 6 G/M^2, Pa
    double elastic_rate;     ///< a = (1 + e_0)/kappa [-]
    double plastic_rate;     ///< b = (1 + e_0)/(lambda - kappa) [-]

    /// State at a plastic compression.
    struct State
    {
      Number pressure, preconsolidation, kept; ///< p, p_c, Pa; w [-]
      Number excess, slope;                    ///< f, df/dx, Pa^2
    };

    TALUS_ALWAYS_INLINE State
    at(const Number &x) const
    {
      const double tiny   = std::numeric_limits<double>::min();
      const Number p      = pressure * exp(-elastic_rate * x);
      const Number p_c    = preconsolidation * exp(plastic_rate * x);
      const Number side   = 2. * p - p_c;
      const Number turn   = -2. * elastic_rate * p - plastic_rate * p_c;
      const Number sum    = side + shear_modulus * x;
      const Number sign   = select(sum < Number(0.), Number(-1.), Number(1.));
      const Number over   = 1. / (sum + sign * tiny);
      const Number kept   = side * over;
      const Number q      = kept * shear;
      const Number change = shear_modulus * (turn * x - side) * over * over;
      // At the critical state w is 0/0, and follows from f = 0.
      const Number on_surface =
        sqrt(max(Number(p * (p_c - p)), Number(0.))) / (shear + tiny);
      return {p,
              p_c,
              select(side * side < 1e-6 * p_c * p_c, on_surface, kept),
              q * q + p * (p - p_c),
              2. * q * shear * change - elastic_rate * p * side -
                plastic_rate * p * p_c};
    }

    /// Plastic compression at which the critical state would be reached [-].
    TALUS_ALWAYS_INLINE Number
    critical() const
    {
      return log(2. * pressure / preconsolidation) *
             (1. / (elastic_rate + plastic_rate));
    }

    /// Return x in the lanes of @p yields by Newton's method within the
    /// bracket; NaN if it is not found.
    template <typename Mask>
    TALUS_ALWAYS_INLINE Number
    solve(const Mask yields) const
    {
      Number x = 0., inner = 0., outer = critical();
      // The iteration ends by steps that are small against the distance over
      // which f changes: that to the critical state, or the shorter one over
      // which little strength removes the deviator.
      const Number side = 2. * pressure - preconsolidation;
      const Number near = max(side, Number(-side)) + 1e-6 * preconsolidation;
      const Number far =
        max(outer, Number(-outer)) + 1e-6 / (elastic_rate + plastic_rate);
      const Number size   = far * near / (near + shear_modulus * far);
      const auto   failed = until_converged(yields, [&](const Mask active) {
        const State state    = at(x);
        const auto  is_inner = state.excess > Number(0.);
        inner                = select(is_inner, x, inner);
        outer                = select(is_inner, outer, x);
        const Number newton  = x - state.excess / state.slope;
        const auto   is_in_bracket =
          (newton - inner) * (newton - outer) <= Number(0.);
        const Number next =
          select(is_in_bracket, newton, Number(0.5 * (inner + outer)));
        const Number step = (next - x) / size;
        x                 = select(active, next, x);
        return step;
      });
      return select(failed,
                    Number(std::numeric_limits<double>::quiet_NaN()),
                    x);
    }
  };



  /// Modified Cam clay with the critical state of Mohr-Coulomb's criterion: an
  /// ellipse in p and q whose slope M depends on the Lode angle as for a
  /// friction angle, see mohr_coulomb_shear(), a return along the deviator, and
  /// an elastic volume with p = p_0 exp(-eps_v (1 + e_0)/kappa)
  /// @cite roscoe1968 @cite wood1990. The plastic variable is the
  /// preconsolidation pressure. The moduli at a point are those of the law
  /// times the pressure() at the start of the step.
  struct CamClayFlow
  {
    double friction;      ///< tan(phi) of the critical state [-]
    double shear_modulus; ///< G over pressure() [-]
    double elastic_rate;  ///< K over pressure(), (1 + e_0)/kappa [-]
    double plastic_rate;  ///< (1 + e_0)/(lambda - kappa) [-]
    double attraction;    ///< Pa

    /// Mean effective stress and attraction, Pa. Positive also in soil torn
    /// apart, and where a mean over points has left none.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    pressure(const Number &mean_stress) const
    {
      return max(Number(attraction - mean_stress), Number(1e-6 * attraction));
    }

    /// Pressure, Pa, below which no yield surface of the preconsolidation
    /// pressure @p p_c contains a deviator with @p square = s:s/2: t^2 <= M^2/3
    /// p (p_c - p), with at least M^2 = 3.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    smallest_pressure(const Number &square,
                      const Number &p_c,
                      const Number &factor) const
    {
      const Number s     = sine(factor);
      const Number slope = 6. * s / (3. - s); // M in triaxial compression
      return square /
             (p_c * max(Number(1.), Number(slope * slope * (1. / 3.))));
    }

    /// Bulk modulus, Pa, over a step from the pressure @p start with the
    /// volumetric strain @p volume [-], so that the pressure becomes p_0
    /// exp(-a volume).
    template <typename Strength, typename Number>
    TALUS_ALWAYS_INLINE Number
    bulk_modulus(const Strength &start, const Number &volume) const
    {
      const Number strain = elastic_rate * volume;
      return elastic_rate * start *
             select(strain * strain < Number(1e-10),
                    Number(1. - 0.5 * strain),
                    Number((1. - exp(-1. * strain)) / strain));
    }

    /// Sine of the friction angle times the strength @p factor.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    sine(const Number &factor) const
    {
      // Soil without friction would have no shape of the yield surface.
      const Number tangent = max(Number(friction * factor), Number(1e-6));
      return tangent / sqrt(1. + tangent * tangent);
    }

    /// Return of @p trial, with the preconsolidation pressure @p p_c and the
    /// pressure() @p start at the start of the step.
    template <int dim, typename Number, typename Strength>
    TALUS_ALWAYS_INLINE CamClayReturn<Number>
                        equation(const StressStep<dim, Number> &trial,
                                 const Strength                &p_c,
                                 const Strength                &start,
                                 const Strength                &sine) const
    {
      const auto  &s = trial.deviator_after;
      const Number t =
        sqrt(0.5 * contract(s, s) + std::numeric_limits<double>::min());
      const Number share =
        mohr_coulomb_shear<dim, Number>(s, t, sine) / (t * sine);
      return {pressure(trial.mean_after),
              Number(p_c),
              share * t,
              2. * shear_modulus * start * share * share,
              elastic_rate,
              plastic_rate};
    }

    template <int dim, typename Number, typename Strength>
    TALUS_ALWAYS_INLINE Flow<Number, Number>
                        operator()(const StressStep<dim, Number> &trial,
               const Strength                &preconsolidation,
               const PointStrength<Strength> &strength) const
    {
      const auto exact = equation(trial,
                                  preconsolidation,
                                  strength.stiffness,
                                  sine(strength.factor));
      // The root is found without derivatives. A last step of Newton's method
      // by numbers with derivatives gives those of the root.
      using Plain = std::decay_t<decltype(value_of(exact.shear))>;
      const CamClayReturn<Plain> plain{value_of(exact.pressure),
                                       value_of(exact.preconsolidation),
                                       value_of(exact.shear),
                                       value_of(exact.shear_modulus),
                                       elastic_rate,
                                       plastic_rate};
      const auto                 yields =
        plain.shear * plain.shear +
          plain.pressure * (plain.pressure - plain.preconsolidation) >
        Plain(0.);
      const Plain  root = plain.solve(yields);
      const Plain  far  = plain.critical() * elastic_rate;
      const Number x =
        select(far * far < Plain(1e-18), // the slope would be noise
               exact.critical(),
               Number(root -
                      exact.at(Number(root)).excess / plain.at(root).slope));
      const auto end = exact.at(select(yields, x, Number(0.)));
      return {select(yields, Number(1. - end.kept), Number(0.)),
              end.preconsolidation - preconsolidation,
              (end.pressure - (attraction - trial.mean_after)) / trial.bulk};
    }
  };

  template <>
  inline constexpr bool is_iterative<CamClayFlow> = true;

  template <>
  inline constexpr bool is_stiffened_by_pressure<CamClayFlow> = true;
} // namespace talus

#endif
