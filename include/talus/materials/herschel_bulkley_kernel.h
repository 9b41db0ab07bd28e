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
  /// Strength as a function of the plastic shear strain of a step: falls
  /// exponentially. Stresses in Pa.
  template <typename Number>
  struct ExponentialSoftening
  {
    Number strength; ///< at the start of the step
    Number loss;     ///< strength that remoulding can still remove
    Number decay;    ///< rate of the loss per plastic shear strain [-]
    Number modulus;  ///< elastic shear modulus

    /// Change of the strength by the plastic shear strain @p x, and its slope.
    TALUS_ALWAYS_INLINE std::pair<Number, Number>
                        change(const Number x) const
    {
      return stress_taken(x, loss, Number(0.), decay);
    }

    /// Upper bound of the plastic shear strain that takes up @p excess at rest.
    TALUS_ALWAYS_INLINE Number
    at_rest(const Number excess) const
    {
      return max_shear(excess, loss, modulus, decay);
    }
  };



  /// Radial return of the law of Herschel and Bulkley. The plastic variable is
  /// the plastic shear strain. The decay of `resistance` is per softening.
  struct HerschelBulkleyFlow
  {
    double remoulded_ratio; ///< remoulded over undisturbed strength [-]
    ShearResistance resistance;

    /// Return the flow in a load step: infinitely slow, so without viscous
    /// stress. Remoulding acts with the plastic shear of previous load steps.
    template <int dim, typename Number>
    Flow<Number>
    operator()(const StressStep<dim, Number> &trial,
               const double                   softening,
               const PointStrength<double>   &strength) const
    {
      const auto  &deviator = trial.deviator_after;
      const auto   at_rest  = curve(softening, strength);
      const Number tau      = sqrt(0.5 * contract(deviator, deviator) +
                              std::numeric_limits<double>::min());
      const Number d_xi =
        max(Number((tau - at_rest.strength) / at_rest.modulus), Number{});
      return {at_rest.modulus * d_xi / tau, d_xi};
    }

    /// Factor of s:s in the square of tau.
    static constexpr double square_of_stress = 0.5;

    /// Strength without viscosity over the plastic shear strain of a step, see
    /// plastic_increment() for rate effects.
    template <typename Number>
    TALUS_ALWAYS_INLINE ExponentialSoftening<Number>
    curve(const Number softening, const PointStrength<Number> &strength) const
    {
      Number loss = (1. - remoulded_ratio) * strength.undisturbed;
      if (resistance.decay > 0.)
        loss *= exp(-resistance.decay * softening);
      return {remoulded_ratio * strength.undisturbed + loss,
              loss,
              resistance.decay * strength.softening,
              resistance.modulus * strength.stiffness};
    }
  };

  template <>
  inline constexpr unsigned int n_registers_at_once<HerschelBulkleyFlow> = 4;



  /// Trial state of point(s) before the return.
  template <int dim, typename Number>
  struct ViscoplasticTrial : RateLawTrial<dim, Number>
  {
    Number                       shear_stress; ///< trial shear stress, Pa
    ExponentialSoftening<Number> curve;        ///< without viscosity
  };



  /// Compute the trial state of point(s) @p p, and advance the deformation
  /// gradient.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE ViscoplasticTrial<dim, Number>
  viscoplastic_trial(const RateLawStep<dim, HerschelBulkleyFlow> &step,
                     const unsigned int                           p)
  {
    const auto  trial = rate_law_trial<dim, Number>(step, p);
    const auto &s     = trial.stress.deviator_after;
    return {trial,
            sqrt(0.5 * contract(s, s) + std::numeric_limits<double>::min()),
            step.flow_rule.curve(softening<Number>(step, p), trial.strength)};
  }



  /// Complete the step with the solved @p plastic_shear. Returns false if a
  /// point is inverted or if plastic_shear is NaN, not solved.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE bool
  flow(const RateLawStep<dim, HerschelBulkleyFlow> &step,
       const unsigned int                           p,
       const ViscoplasticTrial<dim, Number>        &trial,
       const Number                                &plastic_shear)
  {
    soften(step, p, plastic_shear, trial.strength);
    flow_plastically<dim, Number>(step.points,
                                  p,
                                  trial,
                                  Flow<Number>{trial.moduli.mu * plastic_shear /
                                                 trial.shear_stress,
                                               plastic_shear});
    return all(trial.motion.volume_after > 0.) && all(plastic_shear >= 0.);
  }



  /// Overload for explicit steps. The iteration for the plastic shear takes
  /// most of the time, and its operations depend on each other, so several
  /// registers are iterated side by side. Returns false also if the plastic
  /// shear of a point is not found.
  template <int dim, typename Number, unsigned int n_parts>
  TALUS_ALWAYS_INLINE bool
  update_rate_law_points(const RateLawStep<dim, HerschelBulkleyFlow> &step,
                         const unsigned int                           p)
  {
    using Wide = std::conditional_t<n_parts == 1, Number, WideSimd<n_parts>>;
    constexpr unsigned int         width = sizeof(Number) / sizeof(double);
    const ShearResistance         &r     = step.flow_rule.resistance;
    ViscoplasticTrial<dim, Number> trial[n_parts];
    for (unsigned int i = 0; i < n_parts; ++i)
      trial[i] = viscoplastic_trial<dim, Number>(step, p + i * width);
    const auto of_trials = [&](const auto &value) TALUS_INLINE_LAMBDA {
      if constexpr (n_parts == 1)
        return value(trial[0]);
      else
        return Wide::of([&](const unsigned int i)
                          TALUS_INLINE_LAMBDA { return value(trial[i]); });
    };
    const Wide excess = of_trials([](const auto &t) TALUS_INLINE_LAMBDA {
      return t.shear_stress - t.curve.strength;
    });
    const Wide loss =
      of_trials([](const auto &t) TALUS_INLINE_LAMBDA { return t.curve.loss; });
    const Wide modulus = of_trials(
      [](const auto &t) TALUS_INLINE_LAMBDA { return t.curve.modulus; });
    const Wide decay = of_trials(
      [](const auto &t) TALUS_INLINE_LAMBDA { return t.curve.decay; });
    const Wide shear = plastic_shear<Wide>(
      excess,
      loss,
      ShearResistanceOf<Wide>{modulus, r.consistency, r.exponent, decay, r.dt});
    if constexpr (n_parts == 1)
      return flow(step, p, trial[0], shear);
    else
      {
        bool is_sound = true;
        for (unsigned int i = 0; i < n_parts; ++i)
          is_sound &= flow(step, p + i * width, trial[i], shear.part[i]);
        return is_sound;
      }
  }
} // namespace talus

#endif
