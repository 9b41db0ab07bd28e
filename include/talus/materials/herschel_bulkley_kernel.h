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
  /// Strength at rest, which remoulding lowers.
  struct Strength
  {
    double undisturbed;       ///< Pa
    double remoulded_ratio;   ///< share of it that remoulding leaves
    double strain_to_remould; ///< xi_95
    double remoulded = remoulded_ratio * undisturbed;        ///< Pa
    double loss      = (1. - remoulded_ratio) * undisturbed; ///< Pa

    /// At a plastic shear strain, Pa.
    double
    at(const double plastic_shear, const double factor) const
    {
      const double r = remoulded_ratio;
      return factor * undisturbed *
             (r + (1. - r) * std::exp(-3. * plastic_shear / strain_to_remould));
    }
  };



  /// The radial return of Herschel and Bulkley's law. The plastic variable is the
  /// plastic shear strain.
  struct HerschelBulkleyFlow
  {
    Strength        strength;
    ShearResistance resistance;

    /// In a load step: there is time for all to flow, so that viscosity takes no
    /// share. Remoulding follows from one load step to the next.
    template <std::size_t n, typename Number>
    Flow<Number>
    operator()(const std::array<Number, n> &deviator,
               const double                 plastic_shear,
               const double                 strength_factor) const
    {
      const double mu  = resistance.modulus;
      const Number tau = sqrt(0.5 * contract(deviator, deviator) +
                              std::numeric_limits<double>::min());
      const Number d_xi =
        max(Number((tau - strength.at(plastic_shear, strength_factor)) / mu),
            Number{});
      return {mu * d_xi / tau, d_xi};
    }
  };

  template <>
  constexpr unsigned int n_registers_at_once<HerschelBulkleyFlow> = 4;



  /// A step of point(s) up to what the return needs.
  template <int dim, typename Number>
  struct ViscoplasticTrial
  {
    Motion<dim, Number>          motion;
    StrainIncrement<dim, Number> strain;
    ElasticTrial<dim, Number>    elastic;
    Number                       shear_stress; ///< of the trial, Pa
    Number                       old_strain;   ///< plastic shear, before
    Number                       strength;     ///< at the start of the step, Pa
    Number                       loss; ///< part of it that remoulding takes, Pa
  };



  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE ViscoplasticTrial<dim, Number>
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
    ViscoplasticTrial<dim, Number> trial;
    trial.motion = advance_deformation<dim, Number>(points, workspace, p, dt);
    trial.strain = strain_increment(trial.motion);
    trial.elastic =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 trial.strain,
                                 moduli);
    const auto &s = trial.elastic.deviator_after;
    trial.shear_stress =
      sqrt(0.5 * contract(s, s) + std::numeric_limits<double>::min());
    trial.old_strain = load<Number>(points.data(plastic_shear_strain) + p);
    trial.loss       = Number(strength.loss) * strength_factor;
    if (decay > 0.)
      trial.loss *= exp(-decay * trial.old_strain);
    trial.strength = Number(strength.remoulded) * strength_factor + trial.loss;
    return trial;
  }



  /// The end of the step, once its plastic shear is known; false if a point was
  /// turned inside out or the plastic shear, then NaN, was not found.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE bool
  flow(const PointsView<dim>                &points,
       const unsigned int                    p,
       const unsigned int                    plastic_shear_strain,
       const double                          mu,
       const ViscoplasticTrial<dim, Number> &trial,
       const Number                         &plastic_shear)
  {
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



  /// In explicit steps what takes the time is the iteration for the plastic
  /// shear, whose operations wait for each other: so it is made for all registers
  /// side by side. False also if the plastic shear of a point was not found.
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
    constexpr unsigned int         width      = sizeof(Number) / sizeof(double);
    const ShearResistance         &resistance = flow_rule.resistance;
    ViscoplasticTrial<dim, Number> trial[n_parts];
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
             moduli.mu,
             trial[0],
             plastic_shear<Number>(trial[0].shear_stress - trial[0].strength,
                                   trial[0].loss,
                                   resistance));
    else
      {
        WideSimd<n_parts> excess, loss;
        for (unsigned int i = 0; i < n_parts; ++i)
          {
            excess.part[i] = trial[i].shear_stress - trial[i].strength;
            loss.part[i]   = trial[i].loss;
          }
        const auto shear =
          plastic_shear<WideSimd<n_parts>>(excess, loss, resistance);
        for (unsigned int i = 0; i < n_parts; ++i)
          is_sound &= flow(points,
                           p + i * width,
                           plastic_shear_strain,
                           moduli.mu,
                           trial[i],
                           shear.part[i]);
      }
    return is_sound;
  }
} // namespace talus

#endif
