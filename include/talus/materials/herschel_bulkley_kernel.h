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
    double
    at(const double plastic_shear, const double share) const
    {
      const double r = remoulded_ratio;
      return share * undisturbed *
             (r + (1. - r) * std::exp(-3. * plastic_shear / strain_to_remould));
    }
  };



  /// Radial return of the law of Herschel and Bulkley. The plastic variable is
  /// the plastic shear strain.
  struct HerschelBulkleyFlow
  {
    Strength        strength;
    ShearResistance resistance;

    /// Return the flow in a load step: infinitely slow, so without viscous
    /// stress. Remoulding acts with the plastic shear of previous load steps.
    template <std::size_t n, typename Number, typename Factor>
    Flow<Number>
    operator()(const std::array<Number, n> &deviator,
               const double                 plastic_shear,
               const Factor                &strength_factor) const
    {
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
  };

  template <>
  inline constexpr unsigned int n_registers_at_once<HerschelBulkleyFlow> = 4;



  /// Trial state of point(s) before the return.
  template <int dim, typename Number, typename Modulus>
  struct ViscoplasticTrial
  {
    Modulus                      modulus; ///< for shear, Pa
    Motion<dim, Number>          motion;
    StrainIncrement<dim, Number> strain;
    ElasticTrial<dim, Number>    elastic;
    Number                       shear_stress; ///< trial shear stress, Pa
    Number                       old_strain;   ///< plastic shear, before
    Number                       strength;     ///< at the start of the step, Pa
    Number                       loss; ///< largest loss by remoulding, Pa
  };



  /// Type of the trial for points with a strength factor of type @p Factor.
  template <int dim, typename Number, typename Factor>
  using ViscoplasticTrialWith =
    ViscoplasticTrial<dim,
                      Number,
                      decltype(modulus_of_point(double(),
                                                std::declval<Factor>()))>;



  /// Compute the trial state of point(s) @p p in a step of @p dt seconds, and
  /// advance the deformation gradient.
  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE ViscoplasticTrialWith<dim, Number, Factor>
                      viscoplastic_trial(const PointsView<dim>    &points,
                                         const WorkspaceView<dim> &workspace,
                                         const unsigned int        p,
                                         const unsigned int        plastic_shear_strain,
                                         const double              dt,
                                         const Moduli             &moduli,
                                         const Strength           &strength,
                                         const double              decay,
                                         const Factor             &strength_factor)
  {
    ViscoplasticTrialWith<dim, Number, Factor> trial;
    const auto moduli_here = moduli_of_point(moduli, strength_factor);
    const auto share       = share_of_strength(strength_factor);
    trial.modulus          = moduli_here.mu;
    trial.motion = advance_deformation<dim, Number>(points, workspace, p, dt);
    trial.strain = strain_increment(trial.motion);
    trial.elastic =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 trial.strain,
                                 moduli_here);
    const auto &s = trial.elastic.deviator_after;
    trial.shear_stress =
      sqrt(0.5 * contract(s, s) + std::numeric_limits<double>::min());
    trial.old_strain = load<Number>(points.data(plastic_shear_strain) + p);
    trial.loss       = Number(strength.loss) * share;
    if (decay > 0.)
      trial.loss *= exp(-decay * trial.old_strain);
    trial.strength = Number(strength.remoulded) * share + trial.loss;
    return trial;
  }



  /// Complete the step with the solved @p plastic_shear. Returns false if a
  /// point is inverted or if plastic_shear is NaN, not solved.
  template <int dim, typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE bool
  flow(const PointsView<dim>                         &points,
       const unsigned int                             p,
       const unsigned int                             plastic_shear_strain,
       const ViscoplasticTrial<dim, Number, Modulus> &trial,
       const Number                                  &plastic_shear)
  {
    const Modulus mu = trial.modulus;
    store(points.data(plastic_shear_strain) + p,
          trial.old_strain + plastic_shear);
    return_radially<dim, Number>(points,
                                 p,
                                 trial.motion,
                                 trial.strain,
                                 trial.elastic,
                                 mu,
                                 mu * plastic_shear / trial.shear_stress);
    return all(trial.motion.J_after > 0.) && all(plastic_shear >= 0.);
  }



  template <typename Modulus>
  TALUS_ALWAYS_INLINE ShearResistanceOf<Modulus>
  with_modulus(const ShearResistance &r, const Modulus &modulus)
  {
    return {modulus, r.consistency, r.exponent, r.decay, r.dt};
  }



  /// Shear modulus of all trials, Pa: one number, or one for each point.
  template <unsigned int n_parts, int dim, typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE auto
  modulus_of(const ViscoplasticTrial<dim, Number, Modulus> *trial)
  {
    if constexpr (std::is_same_v<Modulus, double>)
      return trial[0].modulus;
    else
      {
        WideSimd<n_parts> modulus;
        for (unsigned int i = 0; i < n_parts; ++i)
          modulus.part[i] = trial[i].modulus;
        return modulus;
      }
  }



  /// Overload for explicit steps. The iteration for the plastic shear takes
  /// most of the time, and its operations depend on each other, so several
  /// registers are iterated side by side. Returns false also if the plastic
  /// shear of a point is not found.
  template <int dim, typename Number, unsigned int n_parts, typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_rate_law_points(const PointsView<dim>     &points,
                         const WorkspaceView<dim>  &workspace,
                         const unsigned int         p,
                         const unsigned int         plastic_shear_strain,
                         const double               dt,
                         const Moduli              &moduli,
                         const HerschelBulkleyFlow &flow_rule,
                         const Factor              &factor)
  {
    using Trial =
      ViscoplasticTrialWith<dim, Number, decltype(factor(p, Number()))>;
    constexpr unsigned int width      = sizeof(Number) / sizeof(double);
    const ShearResistance &resistance = flow_rule.resistance;
    Trial                  trial[n_parts];
    for (unsigned int i = 0; i < n_parts; ++i)
      trial[i] =
        viscoplastic_trial<dim, Number>(points,
                                        workspace,
                                        p + i * width,
                                        plastic_shear_strain,
                                        dt,
                                        moduli,
                                        flow_rule.strength,
                                        resistance.decay,
                                        factor(p + i * width, Number()));
    bool is_sound = true;
    if constexpr (n_parts == 1)
      is_sound =
        flow(points,
             p,
             plastic_shear_strain,
             trial[0],
             plastic_shear<Number>(trial[0].shear_stress - trial[0].strength,
                                   trial[0].loss,
                                   with_modulus(resistance, trial[0].modulus)));
    else
      {
        WideSimd<n_parts> excess, loss;
        for (unsigned int i = 0; i < n_parts; ++i)
          {
            excess.part[i] = trial[i].shear_stress - trial[i].strength;
            loss.part[i]   = trial[i].loss;
          }
        const auto shear = plastic_shear<WideSimd<n_parts>>(
          excess, loss, with_modulus(resistance, modulus_of<n_parts>(trial)));
        for (unsigned int i = 0; i < n_parts; ++i)
          is_sound &= flow(points,
                           p + i * width,
                           plastic_shear_strain,
                           trial[i],
                           shear.part[i]);
      }
    return is_sound;
  }
} // namespace talus

#endif
