// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_kernel_h
#define talus_materials_rate_law_kernel_h

#include <talus/materials/elastic_trial_kernel.h>
#include <talus/materials/point_strength_kernel.h>

#include <type_traits>

namespace talus
{
  /// Dilation of plastic flow at constant volume: zero, without computation.
  struct NoDilation
  {};

  template <typename Number>
  TALUS_ALWAYS_INLINE NoDilation
  operator*(const Number &, NoDilation)
  {
    return {};
  }

  template <typename Number>
  TALUS_ALWAYS_INLINE Number
  operator-(const Number &x, NoDilation)
  {
    return x;
  }



  /// Return of a trial stress to the yield surface by plastic flow. @p Dilation
  /// is Number for soil with friction, whose mean stress changes, too.
  template <typename Number, typename Dilation = NoDilation>
  struct Flow
  {
    Number   removed;       ///< fraction of the trial deviator removed [-]
    Number   increment;     ///< increment of the plastic variable [-]
    Dilation dilation = {}; ///< plastic volumetric strain of the step [-]
  };



  /// Flow rule of elastic material.
  struct NoFlow
  {
    template <int dim, typename Number, typename Strength>
    Flow<Number>
    operator()(const StressStep<dim, Number> & /*trial*/,
               const Strength & /*softening*/,
               const PointStrength<Strength> & /*strength*/) const
    {
      return {Number(0.), Number(0.)};
    }
  };



  /// Constants of a step of a law in rate form, and the points to be advanced.
  template <int dim, typename FlowRule>
  struct RateLawStep
  {
    PointsView<dim>    points;
    WorkspaceView<dim> workspace; ///< velocity gradients, 1/s
    unsigned int       plastic;   ///< column of the plastic variable
    double             dt;        ///< s
    Moduli             moduli;    ///< elastic constants of the law, Pa
    FlowRule           flow_rule;
    StrengthOfPoints   strength;
  };



  /// Softening of point(s) @p p at the start of the step [-].
  template <typename Number, int dim, typename FlowRule>
  TALUS_ALWAYS_INLINE Number
  softening(const RateLawStep<dim, FlowRule> &step, const unsigned int p)
  {
    return load<Number>(step.points.data(step.strength.softening_column) + p);
  }



  /// Add the @p increment of a step to the plastic variable of point(s) @p p
  /// and to their softening, which may be the same column.
  template <int dim, typename Number, typename FlowRule>
  TALUS_ALWAYS_INLINE void
  soften(const RateLawStep<dim, FlowRule> &step,
         const unsigned int                p,
         const Number                     &increment,
         const PointStrength<Number>      &strength)
  {
    double *const plastic = step.points.data(step.plastic) + p;
    store(plastic, load<Number>(plastic) + increment);
    if (step.strength.softening_column != step.plastic)
      store(step.points.data(step.strength.softening_column) + p,
            softening<Number>(step, p) + strength.softening * increment);
  }



  /// Motion, strain and stress of point(s) in a step without plastic flow.
  template <int dim, typename Number>
  struct RateLawTrial
  {
    Motion<dim, Number>          motion;
    StrainIncrement<dim, Number> strain;
    PointStrength<Number>        strength;
    ModuliOf<Number>             moduli;     ///< elastic constants, Pa
    Number                       compliance; ///< inverse of moduli.mu, 1/Pa
    StressStep<dim, Number>      stress;
  };



  /// Compute the trial stress of point(s) @p p from motion and strain.
  template <int dim, typename Number, typename FlowRule>
  TALUS_ALWAYS_INLINE void
  set_trial_stress(const RateLawStep<dim, FlowRule> &step,
                   const unsigned int                p,
                   RateLawTrial<dim, Number>        &trial)
  {
    trial.strength   = step.strength(p, Number());
    trial.moduli     = moduli_of_point(step.moduli, trial.strength);
    trial.compliance = 1. / step.moduli.mu * trial.strength.compliance;
    trial.stress =
      elastic_trial<dim, Number>(load_stress<dim, Number>(step.points, p),
                                 trial.strain,
                                 trial.moduli);
  }



  /// Advance the edges of point(s) @p p and compute the trial stress.
  template <int dim, typename Number, typename FlowRule>
  TALUS_ALWAYS_INLINE RateLawTrial<dim, Number>
  rate_law_trial(const RateLawStep<dim, FlowRule> &step, const unsigned int p)
  {
    RateLawTrial<dim, Number> trial;
    trial.motion =
      advance_edges<dim, Number>(step.points, step.workspace, p, step.dt);
    trial.strain = strain_increment(trial.motion);
    set_trial_stress(step, p, trial);
    return trial;
  }



  /// Complete an elastic step of point(s) @p p: store the stress and record the
  /// work as elastic energy.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE void
  keep_elastic(const PointsView<dim>           &points,
               const unsigned int               p,
               const RateLawTrial<dim, Number> &trial)
  {
    const auto &[motion, strain, strength, moduli, compliance, stress] = trial;
    store_turned_stress<dim, Number>(points, p, strain, stress);

    const auto    force  = deviatoric_force<dim, Number>(motion, stress);
    double *const energy = points.data(points.elastic_energy) + p;
    store(energy,
          load<Number>(energy) +
            work_of_step<dim, Number>(motion, strain, stress, force));
  }



  /// Return the stress of a step with plastic flow. The flow removes a fraction
  /// of the trial deviator, 2 mu times the plastic strain, and the bulk modulus
  /// times the dilation from the mean.
  template <int dim, typename Number, typename Dilation>
  TALUS_ALWAYS_INLINE StressStep<dim, Number>
                      returned(StressStep<dim, Number>       stress,
                               const Number                 &bulk,
                               const Flow<Number, Dilation> &flow)
  {
    for (Number &component : stress.deviator_after)
      component *= 1. - flow.removed;
    stress.mean_after = stress.mean_after - bulk * flow.dilation;
    return stress;
  }



  /// Complete a plastic step of point(s) @p p: store the returned stress and
  /// record the work of the step as plastic and elastic.
  template <int dim, typename Number, typename Dilation>
  TALUS_ALWAYS_INLINE void
  flow_plastically(const PointsView<dim>           &points,
                   const unsigned int               p,
                   const RateLawTrial<dim, Number> &trial,
                   const Flow<Number, Dilation>    &flow)
  {
    const auto &[motion, strain, strength, moduli, compliance, trial_stress] =
      trial;
    const auto stress = returned(trial_stress, moduli.bulk, flow);
    store_turned_stress<dim, Number>(points, p, strain, stress);

    const auto force        = deviatoric_force<dim, Number>(motion, stress);
    Number     plastic_work = flow.removed * (0.5 * compliance) *
                          contract(force, trial_stress.deviator_after);
    if constexpr (std::is_same_v<Number, Dilation>)
      plastic_work += volumetric_work(motion, stress, flow.dilation);
    const Number work =
      work_of_step<dim, Number>(motion, strain, stress, force);
    double *const elastic = points.data(points.elastic_energy) + p;
    double *const plastic = points.data(points.plastic_work) + p;
    store(elastic, load<Number>(elastic) + (work - plastic_work));
    store(plastic, load<Number>(plastic) + plastic_work);
  }



  /// Number of registers of points processed side by side by a flow rule: 1
  /// unless the rule iterates.
  template <typename FlowRule>
  constexpr unsigned int n_registers_at_once = 1;

  /// Whether the flow rule iterates, so that the increment of the plastic
  /// variable may be NaN, not found.
  template <typename FlowRule>
  constexpr bool is_iterative = false;



  /// Advance the points from @p p on, in @p n registers, by one step of a law
  /// in rate form. Returns false if a point is inverted or its flow not found.
  template <int dim, typename Number, unsigned int n, typename FlowRule>
  TALUS_ALWAYS_INLINE bool
  update_rate_law_points(const RateLawStep<dim, FlowRule> &step,
                         const unsigned int                p)
  {
    static_assert(n == 1);
    const auto trial = rate_law_trial<dim, Number>(step, p);
    if constexpr (std::is_same_v<FlowRule, NoFlow>)
      keep_elastic(step.points, p, trial);
    else
      {
        const auto flow = step.flow_rule(trial.stress,
                                         softening<Number>(step, p),
                                         trial.strength);
        soften(step, p, flow.increment, trial.strength);
        flow_plastically(step.points, p, trial, flow);
        if constexpr (is_iterative<FlowRule>)
          if (!all(flow.increment >= 0.))
            return false;
      }
    return all(trial.motion.volume_after > 0.);
  }
} // namespace talus

#endif
