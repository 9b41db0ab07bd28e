// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_herschel_bulkley_kernel_h
#define talus_materials_herschel_bulkley_kernel_h

#include <talus/base/wide_simd.h>
#include <talus/materials/rate_law_kernel.h>
#include <talus/materials/viscoplastic_return_kernel.h>

#include <cmath>
#include <limits>

namespace talus
{
  /// Strength at rest as a function of remoulding.
  struct Strength
  {
    double undisturbed;       ///< Pa
    double remoulded_ratio;   ///< remoulded over undisturbed strength [-]
    double strain_to_remould; ///< xi_95 [-]
    double remoulded = remoulded_ratio * undisturbed;        ///< Pa
    double loss      = (1. - remoulded_ratio) * undisturbed; ///< Pa

    /// Strength at a plastic shear strain [-], times the factor @p share [-],
    /// Pa.
    template <typename Share>
    double
    at(const double plastic_shear, const Share &share) const
    {
      const double r = remoulded_ratio;
      return undisturbed * share *
             (r + (1. - r) * std::exp(-3. * plastic_shear / strain_to_remould));
    }
  };



  /// Strength as a function of the plastic shear strain of a step: falls
  /// exponentially. Stresses in Pa.
  template <typename Number, typename Modulus, typename Decay>
  struct ExponentialSoftening
  {
    Number  strength; ///< at the start of the step
    Number  loss;     ///< strength that remoulding can still remove
    Decay   decay;    ///< rate of the loss per plastic shear strain [-]
    Modulus modulus;  ///< elastic shear modulus

    /// Change of the strength by the plastic shear strain @p x, and its slope.
    TALUS_ALWAYS_INLINE std::pair<Number, Number>
                        change(const Number x) const
    {
      return stress_taken(x, loss, 0., decay);
    }

    /// Upper bound of the plastic shear strain that takes up @p excess at rest.
    TALUS_ALWAYS_INLINE Number
    at_rest(const Number excess) const
    {
      return max_shear(excess, loss, modulus, decay);
    }
  };



  /// Radial return of the law of Herschel and Bulkley. The plastic variable is
  /// the plastic shear strain. Under a BandStrength all strains of remoulding
  /// are values of the softening.
  struct HerschelBulkleyFlow
  {
    Strength        strength;
    ShearResistance resistance;

    /// Return the flow in a load step: infinitely slow, so without viscous
    /// stress. Remoulding acts with the plastic shear of previous load steps.
    template <int dim, typename Number, typename Factor>
    Flow<Number>
    operator()(const StressStep<dim, Number> &trial,
               const double                   plastic_shear,
               const Factor                  &strength_factor) const
    {
      const auto  &deviator = trial.deviator_after;
      const double mu  = modulus_of_point(resistance.modulus, strength_factor);
      const Number tau = sqrt(0.5 * contract(deviator, deviator) +
                              std::numeric_limits<double>::min());
      const Number d_xi =
        max(Number((tau - strength.at(plastic_shear,
                                      share_of_strength(strength_factor))) /
                   mu),
            Number{});
      return {mu * d_xi / tau, d_xi};
    }

    /// Factor of s:s in the square of tau.
    static constexpr double square_of_stress = 0.5;

    /// Strength without viscosity over the plastic shear strain of a step, see
    /// plastic_increment() for rate effects.
    template <typename Number, typename Factor>
    TALUS_ALWAYS_INLINE auto
    curve(const Number softening, const Factor &factor) const
    {
      const auto share   = share_of_strength(factor);
      auto       modulus = modulus_of_point(resistance.modulus, factor);
      auto       decay   = slope_of_point(resistance.decay, factor);
      Number     loss    = Number(strength.loss) * share;
      if (resistance.decay > 0.)
        loss *= exp(-resistance.decay * softening);
      return ExponentialSoftening<Number, decltype(modulus), decltype(decay)>{
        Number(strength.remoulded) * share + loss, loss, decay, modulus};
    }
  };

  template <>
  inline constexpr unsigned int n_registers_at_once<HerschelBulkleyFlow> = 4;



  /// Trial state of point(s) before the return.
  template <int dim, typename Number, typename Modulus, typename Decay>
  struct ViscoplasticTrial : RateLawTrial<dim, Number, Modulus>
  {
    Number shear_stress; ///< trial shear stress, Pa
    Number old_strain;   ///< plastic shear strain at the start of the step [-]
    ExponentialSoftening<Number, Modulus, Decay> curve; ///< without viscosity
  };



  /// Type of the trial for points with a strength factor of type @p Factor.
  template <int dim, typename Number, typename Factor>
  using ViscoplasticTrialWith = ViscoplasticTrial<
    dim,
    Number,
    decltype(modulus_of_point(double(), std::declval<Factor>())),
    decltype(slope_of_point(double(), std::declval<Factor>()))>;



  /// Compute the trial state of point(s) @p p, and advance the deformation
  /// gradient.
  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE ViscoplasticTrialWith<dim, Number, Factor>
  viscoplastic_trial(const RateLawStep<dim, HerschelBulkleyFlow> &step,
                     const unsigned int                           p,
                     const Factor                                &factor)
  {
    const auto   trial      = rate_law_trial<dim, Number>(step, p, factor);
    const auto  &s          = trial.stress.deviator_after;
    const Number old_strain = load<Number>(step.points.data(step.plastic) + p);
    return {trial,
            sqrt(0.5 * contract(s, s) + std::numeric_limits<double>::min()),
            old_strain,
            step.flow_rule.curve(softening_variable<Factor>(
                                   step.points, step.softening, p, old_strain),
                                 factor)};
  }



  /// Complete the step with the solved @p plastic_shear. Returns false if a
  /// point is inverted or if plastic_shear is NaN, not solved.
  template <int dim, typename Number, typename Trial, typename Factor>
  TALUS_ALWAYS_INLINE bool
  flow(const RateLawStep<dim, HerschelBulkleyFlow> &step,
       const unsigned int                           p,
       const Trial                                 &trial,
       const Number                                &plastic_shear,
       const Factor                                &factor)
  {
    store(step.points.data(step.plastic) + p, trial.old_strain + plastic_shear);
    soften(step.points, step.softening, p, plastic_shear, factor);
    flow_plastically<dim, Number>(step.points,
                                  p,
                                  trial,
                                  Flow<Number>{trial.moduli.mu * plastic_shear /
                                                 trial.shear_stress,
                                               plastic_shear});
    return all(trial.motion.volume_after > 0.) && all(plastic_shear >= 0.);
  }



  template <typename Modulus, typename Decay>
  TALUS_ALWAYS_INLINE ShearResistanceOf<Modulus, Decay>
                      with_modulus_and_decay(const ShearResistance &r,
                                             const Modulus         &modulus,
                                             const Decay           &decay)
  {
    return {modulus, r.consistency, r.exponent, decay, r.dt};
  }



  /// Value @p of(i) of all trials: one number, or one for each point.
  template <unsigned int n_parts, typename Function>
  TALUS_ALWAYS_INLINE auto
  of_trials(const Function &of)
  {
    if constexpr (std::is_same_v<std::decay_t<decltype(of(0))>, double>)
      return of(0);
    else
      return WideSimd<n_parts>::of(of);
  }



  /// Overload for explicit steps. The iteration for the plastic shear takes
  /// most of the time, and its operations depend on each other, so several
  /// registers are iterated side by side. Returns false also if the plastic
  /// shear of a point is not found.
  template <int dim, typename Number, unsigned int n_parts, typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_rate_law_points(const RateLawStep<dim, HerschelBulkleyFlow> &step,
                         const unsigned int                           p,
                         const Factor                                &factor)
  {
    using Trial =
      ViscoplasticTrialWith<dim, Number, decltype(factor(p, Number()))>;
    constexpr unsigned int width      = sizeof(Number) / sizeof(double);
    const ShearResistance &resistance = step.flow_rule.resistance;
    const auto factor_of = [&](const unsigned int i) TALUS_INLINE_LAMBDA {
      return factor(p + i * width, Number());
    };
    Trial trial[n_parts];
    for (unsigned int i = 0; i < n_parts; ++i)
      trial[i] =
        viscoplastic_trial<dim, Number>(step, p + i * width, factor_of(i));
    bool is_sound = true;
    if constexpr (n_parts == 1)
      is_sound = flow(
        step,
        p,
        trial[0],
        plastic_shear<Number>(trial[0].shear_stress - trial[0].curve.strength,
                              trial[0].curve.loss,
                              with_modulus_and_decay(resistance,
                                                     trial[0].moduli.mu,
                                                     trial[0].curve.decay)),
        factor_of(0));
    else
      {
        WideSimd<n_parts> excess, loss;
        for (unsigned int i = 0; i < n_parts; ++i)
          {
            excess.part[i] = trial[i].shear_stress - trial[i].curve.strength;
            loss.part[i]   = trial[i].curve.loss;
          }
        const auto shear = plastic_shear<WideSimd<n_parts>>(
          excess,
          loss,
          with_modulus_and_decay(
            resistance,
            of_trials<n_parts>([&](const unsigned int i) TALUS_INLINE_LAMBDA {
              return trial[i].moduli.mu;
            }),
            of_trials<n_parts>([&](const unsigned int i) TALUS_INLINE_LAMBDA {
              return trial[i].curve.decay;
            })));
        for (unsigned int i = 0; i < n_parts; ++i)
          is_sound &=
            flow(step, p + i * width, trial[i], shear.part[i], factor_of(i));
      }
    return is_sound;
  }
} // namespace talus

#endif
