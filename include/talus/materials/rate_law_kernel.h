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
    template <int dim, typename Number, typename Factor>
    Flow<Number>
    operator()(const StressStep<dim, Number> & /*trial*/,
               double /*plastic*/,
               const Factor & /*strength_factor*/) const
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
    /// Column of the softening; used only with BandStrength.
    unsigned int softening = 0;
  };



  /// Variable of the flow rule at point(s) @p p: under a BandStrength the value
  /// in the column @p softening, otherwise the plastic variable @p plastic.
  template <typename Factor, int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  softening_variable([[maybe_unused]] const PointsView<dim> &points,
                     [[maybe_unused]] const unsigned int     softening,
                     [[maybe_unused]] const unsigned int     p,
                     const Number                           &plastic)
  {
    if constexpr (is_band_strength<Factor>)
      return load<Number>(points.data(softening) + p);
    else
      return plastic;
  }



  /// Add the softening by an increment of the plastic variable.
  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE void
  soften([[maybe_unused]] const PointsView<dim> &points,
         [[maybe_unused]] const unsigned int     softening,
         [[maybe_unused]] const unsigned int     p,
         [[maybe_unused]] const Number          &increment,
         [[maybe_unused]] const Factor          &factor)
  {
    if constexpr (is_band_strength<Factor>)
      {
        double *const column = points.data(softening) + p;
        store(column, load<Number>(column) + slope_of_point(increment, factor));
      }
  }



  /// Motion, strain and stress of point(s) in a step without plastic flow.
  template <int dim, typename Number, typename Modulus>
  struct RateLawTrial
  {
    Motion<dim, Number>          motion;
    StrainIncrement<dim, Number> strain;
    ModuliOf<Modulus>            moduli; ///< elastic constants, Pa
    StressStep<dim, Number>      stress;
  };



  /// Advance the edges of point(s) @p p and compute the trial stress. @p factor
  /// is the strength factor of the point(s).
  template <int dim, typename Number, typename FlowRule, typename Factor>
  TALUS_ALWAYS_INLINE auto
  rate_law_trial(const RateLawStep<dim, FlowRule> &step,
                 const unsigned int                p,
                 const Factor                     &factor)
  {
    RateLawTrial<dim, Number, decltype(modulus_of_point(double(), factor))>
      trial;
    trial.motion =
      advance_edges<dim, Number>(step.points, step.workspace, p, step.dt);
    trial.strain = strain_increment(trial.motion);
    trial.moduli = moduli_of_point(step.moduli, factor);
    trial.stress =
      elastic_trial<dim, Number>(load_stress<dim, Number>(step.points, p),
                                 trial.strain,
                                 trial.moduli);
    return trial;
  }



  /// Complete an elastic step of point(s) @p p: store the stress and record the
  /// work as elastic energy.
  template <int dim, typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE void
  keep_elastic(const PointsView<dim>                    &points,
               const unsigned int                        p,
               const RateLawTrial<dim, Number, Modulus> &trial)
  {
    const auto &[motion, strain, moduli, stress] = trial;
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
  template <int dim, typename Number, typename Modulus, typename Dilation>
  TALUS_ALWAYS_INLINE StressStep<dim, Number>
                      returned(StressStep<dim, Number>       stress,
                               const Modulus                &bulk,
                               const Flow<Number, Dilation> &flow)
  {
    for (Number &component : stress.deviator_after)
      component *= 1. - flow.removed;
    stress.mean_after = stress.mean_after - bulk * flow.dilation;
    return stress;
  }



  /// Complete a plastic step of point(s) @p p: store the returned stress and
  /// record the work of the step as plastic and elastic.
  template <int dim, typename Number, typename Modulus, typename Dilation>
  TALUS_ALWAYS_INLINE void
  flow_plastically(const PointsView<dim>                    &points,
                   const unsigned int                        p,
                   const RateLawTrial<dim, Number, Modulus> &trial,
                   const Flow<Number, Dilation>             &flow)
  {
    const auto &[motion, strain, moduli, trial_stress] = trial;
    const auto stress = returned(trial_stress, moduli.bulk, flow);
    store_turned_stress<dim, Number>(points, p, strain, stress);

    const auto force        = deviatoric_force<dim, Number>(motion, stress);
    Number     plastic_work = flow.removed * (0.5 / moduli.mu) *
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
  /// @p factor is a function as in with_point_strength().
  template <int dim,
            typename Number,
            unsigned int n,
            typename FlowRule,
            typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_rate_law_points(const RateLawStep<dim, FlowRule> &step,
                         const unsigned int                p,
                         const Factor                     &factor)
  {
    static_assert(n == 1);
    const auto factor_here = factor(p, Number());
    const auto trial       = rate_law_trial<dim, Number>(step, p, factor_here);
    if constexpr (std::is_same_v<FlowRule, NoFlow>)
      keep_elastic(step.points, p, trial);
    else
      {
        double *const variable = step.points.data(step.plastic) + p;
        const Number  before   = load<Number>(variable);
        const auto    flow     = step.flow_rule(
          trial.stress,
          softening_variable<std::decay_t<decltype(factor_here)>>(
            step.points, step.softening, p, before),
          factor_here);
        store(variable, before + flow.increment);
        soften(step.points, step.softening, p, flow.increment, factor_here);
        flow_plastically(step.points, p, trial, flow);
        if constexpr (is_iterative<FlowRule>)
          if (!all(flow.increment >= 0.))
            return false;
      }
    return all(trial.motion.volume_after > 0.);
  }
} // namespace talus

#endif
