// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_kernel_h
#define talus_materials_rate_law_kernel_h

#include <talus/materials/elastic_trial_kernel.h>
#include <talus/materials/point_strength_kernel.h>

#include <type_traits>

namespace talus
{
  /// Effect of plastic flow on the trial state.
  template <typename Number>
  struct Flow
  {
    Number removed;   ///< fraction of the trial deviator removed [-]
    Number increment; ///< increment of the plastic variable [-]
  };



  /// Flow rule of elastic material.
  struct NoFlow
  {
    template <std::size_t n, typename Number>
    Flow<Number>
    operator()(const std::array<Number, n> & /*deviator*/,
               double /*plastic*/,
               double /*strength_factor*/) const
    {
      return {Number(0.), Number(0.)};
    }
  };



  /// Complete an elastic step: store the stress and record the work as elastic
  /// energy.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE void
  keep_elastic(const PointsView<dim>              &points,
               const unsigned int                  p,
               const Motion<dim, Number>          &motion,
               const StrainIncrement<dim, Number> &strain,
               const ElasticTrial<dim, Number>    &trial)
  {
    store_turned_stress<dim, Number>(
      points, p, strain, trial.deviator_after, trial.mean_after);

    const auto V0 = load<Number>(points.data(points.reference_volume) + p);
    const auto force =
      deviatoric_force<dim, Number>(motion, V0, trial, trial.deviator_after);
    double *const energy = points.data(points.elastic_energy) + p;
    store(energy,
          load<Number>(energy) +
            work_of_step<dim, Number>(motion, V0, strain, trial, force));
  }



  /// Complete a plastic step by radial return: remove the fraction @p removed
  /// of the trial deviator, which is 2 mu times the plastic strain. Stores the
  /// stress and records the work of the step as plastic and elastic.
  template <int dim, typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE void
  return_radially(const PointsView<dim>              &points,
                  const unsigned int                  p,
                  const Motion<dim, Number>          &motion,
                  const StrainIncrement<dim, Number> &strain,
                  const ElasticTrial<dim, Number>    &trial,
                  const Modulus                      &mu,
                  const Number                       &removed)
  {
    auto deviator = trial.deviator_after;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      deviator[c] *= 1. - removed;
    store_turned_stress<dim, Number>(
      points, p, strain, deviator, trial.mean_after);

    const auto V0 = load<Number>(points.data(points.reference_volume) + p);
    const auto force =
      deviatoric_force<dim, Number>(motion, V0, trial, deviator);
    const Number plastic_work =
      removed * (0.5 / mu) * contract(force, trial.deviator_after);
    const Number work =
      work_of_step<dim, Number>(motion, V0, strain, trial, force);
    double *const elastic = points.data(points.elastic_energy) + p;
    double *const plastic = points.data(points.plastic_work) + p;
    store(elastic, load<Number>(elastic) + (work - plastic_work));
    store(plastic, load<Number>(plastic) + plastic_work);
  }



  /// Number of registers of points processed side by side by a flow rule: 1
  /// unless the rule iterates.
  template <typename FlowRule>
  constexpr unsigned int n_registers_at_once = 1;



  /// Advance the points from @p p on, in @p n registers, by one step of a law
  /// in rate form. Returns false if a point is inverted.
  /// @param points Columns of the points.
  /// @param workspace Velocity gradients.
  /// @param p First point.
  /// @param plastic Column of the plastic variable.
  /// @param dt Time step, s.
  /// @param moduli Elastic constants, Pa.
  /// @param flow_rule Flow rule, as in RateLaw.
  /// @param factor Function as in with_strength_factor().
  template <int dim,
            typename Number,
            unsigned int n,
            typename FlowRule,
            typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_rate_law_points(const PointsView<dim>    &points,
                         const WorkspaceView<dim> &workspace,
                         const unsigned int        p,
                         const unsigned int        plastic,
                         const double              dt,
                         const Moduli             &moduli,
                         const FlowRule           &flow_rule,
                         const Factor             &factor)
  {
    static_assert(n == 1);
    const auto motion =
      advance_deformation<dim, Number>(points, workspace, p, dt);
    const auto strain      = strain_increment(motion);
    const auto factor_here = factor(p, Number());
    const auto moduli_here = moduli_of_point(moduli, factor_here);
    const auto trial =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 strain,
                                 moduli_here);
    if constexpr (std::is_same_v<FlowRule, NoFlow>)
      keep_elastic<dim, Number>(points, p, motion, strain, trial);
    else
      {
        double *const      variable = points.data(plastic) + p;
        const Number       before   = load<Number>(variable);
        const Flow<Number> flow =
          flow_rule(trial.deviator_after, before, factor_here);
        store(variable, before + flow.increment);
        return_radially<dim, Number>(
          points, p, motion, strain, trial, moduli_here.mu, flow.removed);
      }
    return all(motion.J_after > 0.);
  }
} // namespace talus

#endif
