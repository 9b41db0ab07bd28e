// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_kernel_h
#define talus_materials_rate_law_kernel_h

#include <talus/materials/elastic_trial_kernel.h>
#include <talus/materials/point_strength_kernel.h>

#include <type_traits>

namespace talus
{
  /// What plastic flow does to the trial deviator.
  template <typename Number>
  struct Flow
  {
    Number removed;   ///< share of the deviator that goes
    Number increment; ///< of the law's plastic variable
  };



  /// The flow rule of elastic material.
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



  /// The elastic end of a step: stores the stress and books its work.
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



  /// Radial return, once the plastic strain of the step is known: the part
  /// @p removed of the trial deviator goes, which is 2 mu times the plastic
  /// strain. Stores the stress and books the work of the step as plastic and
  /// elastic.
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



  /// How many registers of points a flow rule is to be computed for side by side:
  /// one, unless it iterates.
  template <typename FlowRule>
  constexpr unsigned int n_registers_at_once = 1;



  /// One step of the points that follow @p p, in @p n registers, of a law in rate
  /// form: @p flow_rule as in RateLaw, @p plastic the column of its plastic
  /// variable, @p factor as in with_strength_factor(). False if a point was
  /// turned inside out.
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
