// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_kernel_h
#define talus_materials_rate_law_kernel_h

#include <talus/base/simd.h>
#include <talus/materials/kinematics_kernel.h>
#include <talus/materials/moduli.h>

#include <type_traits>

namespace talus
{
  /// Strength and stiffness of soil at one point, or of several points at once.
  template <typename Number>
  struct PointStrength
  {
    Number undisturbed; ///< undrained shear strength times `factor`, Pa
    Number factor;      ///< strength factor [-]
    Number stiffness;   ///< moduli of the point over the moduli of the law [-]
    Number compliance;  ///< inverse of `stiffness` [-]
    Number softening;   ///< softening per plastic variable [-]
  };



  /// Values at the points: a column, or one number for all points.
  struct ColumnOrNumber
  {
    const double *column = nullptr;
    double        number = 1.;

    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    at(const unsigned int p) const
    {
      return column == nullptr ? Number(number) : load<Number>(column + p);
    }
  };



  /// Function strength(p, number) for the PointStrength of point(s) p.
  struct StrengthOfPoints
  {
    ColumnOrNumber strength = {nullptr, 0.}; ///< undrained shear strength, Pa;
                                             ///< 0 if the law has none
    ColumnOrNumber factor         = {};      ///< strength factor [-]
    ColumnOrNumber stiffness      = {};      ///< as in PointStrength
    ColumnOrNumber cell_size      = {};      ///< m; 1 if not used
    double         softening_rate = 1.; ///< softening over plastic variable and
                                        ///< cell size, 1/m
    /// Column of the softening [-], on which the strength depends: the plastic
    /// variable, or the displacement across a shear band as wide as the cell
    /// over the softening displacement. Invalid in elastic laws.
    unsigned int softening_column = -1;

    template <typename Number>
    TALUS_ALWAYS_INLINE PointStrength<Number>
    operator()(const unsigned int p, const Number & /*number*/) const
    {
      const Number share = factor.at<Number>(p);
      // A division only where points differ.
      const Number ratio = stiffness.at<Number>(p);
      return {share * strength.at<Number>(p),
              share,
              ratio,
              stiffness.column == nullptr ? ratio : Number(1. / ratio),
              softening_rate * cell_size.at<Number>(p)};
    }
  };



  /// Moduli of the point(s), Pa, from the @p moduli of the law.
  template <typename Number>
  TALUS_ALWAYS_INLINE ModuliOf<Number>
  moduli_of_point(const Moduli &moduli, const PointStrength<Number> &strength)
  {
    return {moduli.lambda * strength.stiffness,
            moduli.mu * strength.stiffness,
            moduli.bulk * strength.stiffness};
  }



  /// Stress at the start and at the end of a step of a law in rate form, Pa.
  /// Deviators refer to the axes at mid-step, as does the strain increment.
  template <int dim, typename Number>
  struct StressStep
  {
    Number              mean_before, mean_after;
    Stress<dim, Number> deviator_before, deviator_after;
    Number              bulk; ///< bulk modulus of the step
  };



  /// Integrate Hooke's law for the Jaumann rate of the Cauchy stress
  /// objectively @cite hughes1980. The strain increment belongs to the
  /// configuration at mid-step: the old deviator is rotated to mid-step by half
  /// of the rotation of the step, and by the second half when stored. The
  /// common alternative, adding the increment to the fully rotated stress, is
  /// only of first order if strain and stress are not coaxial; see
  /// @cite simo1998, section 8.3. The mean stress follows K ln det(I + H), so
  /// that -p = K ln J on any path.
  template <int dim, typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE StressStep<dim, Number>
                      elastic_trial(const Stress<dim, Number>          &sigma,
                                    const StrainIncrement<dim, Number> &strain,
                                    const ModuliOf<Modulus>            &moduli)
  {
    StressStep<dim, Number> trial;
    trial.bulk        = moduli.bulk;
    trial.mean_before = mean_normal(sigma);
    trial.mean_after  = trial.mean_before + moduli.bulk * strain.volumetric;

    trial.deviator_before =
      turn(strain.half_rotation, add_mean(sigma, -trial.mean_before));
    trial.deviator_after = trial.deviator_before;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      trial.deviator_after[c] += 2. * moduli.mu * strain.deviatoric[c];
    return trial;
  }



  /// Volume times deviator, mean of start and end of the step, J: the
  /// contraction with a deviatoric strain of the step, plastic or total, gives
  /// the work.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Stress<dim, Number>
                      deviatoric_force(const Motion<dim, Number>     &motion,
                                       const StressStep<dim, Number> &stress)
  {
    const Number        before = 0.5 * motion.volume_before;
    const Number        after  = 0.5 * motion.volume_after;
    Stress<dim, Number> force;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      force[c] =
        before * stress.deviator_before[c] + after * stress.deviator_after[c];
    return force;
  }



  /// Work of the mean stress by a volumetric strain of the step [-], J, by the
  /// trapezoidal rule.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  volumetric_work(const Motion<dim, Number>     &motion,
                  const StressStep<dim, Number> &stress,
                  const Number                  &volumetric_strain)
  {
    return 0.5 * volumetric_strain *
           (motion.volume_before * stress.mean_before +
            motion.volume_after * stress.mean_after);
  }



  /// Work of the stress over the step, J, by the trapezoidal rule; equal to the
  /// work of the nodal forces. At constant volume, its deviatoric part minus
  /// the work of the plastic strain is the exact change of V s:s/(4 mu), so a
  /// cycle neither creates nor loses elastic energy.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  work_of_step(const Motion<dim, Number>          &motion,
               const StrainIncrement<dim, Number> &strain,
               const StressStep<dim, Number>      &stress,
               const Stress<dim, Number>          &force)
  {
    return volumetric_work<dim, Number>(motion, stress, strain.volumetric) +
           contract(force, strain.deviatoric);
  }



  /// Turn the stress at the end of the step from the axes at mid-step to the
  /// axes at the end, and store the result.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE void
  store_turned_stress(const PointsView<dim>              &points,
                      const unsigned int                  p,
                      const StrainIncrement<dim, Number> &strain,
                      const StressStep<dim, Number>      &stress)
  {
    store_stress<dim, Number>(points,
                              p,
                              add_mean(turn(strain.half_rotation,
                                            stress.deviator_after),
                                       stress.mean_after));
  }



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



  /// Whether moduli are those of the law times pressure() of the flow rule, a
  /// function of the mean stress at the start of the step, and the bulk modulus
  /// over a step is bulk_modulus() of the rule.
  template <typename FlowRule>
  constexpr bool is_stiffened_by_pressure = false;



  /// Set the stiffness in @p strength from the stress @p sigma, Pa, before a
  /// step. A mean stress that the law does not allow, left by a mean over
  /// points, becomes one that it does.
  template <int dim, typename FlowRule, typename Number>
  TALUS_ALWAYS_INLINE void
  stiffen(const FlowRule        &flow_rule,
          const Number          &plastic_variable,
          PointStrength<Number> &strength,
          Stress<dim, Number>   &sigma)
  {
    const Number mean = mean_normal(sigma);
    const auto   s    = add_mean(sigma, Number(-mean));
    strength.stiffness =
      max(flow_rule.pressure(mean),
          Number(flow_rule.smallest_pressure(Number(0.5 * contract(s, s)),
                                             plastic_variable,
                                             strength.factor)));
    strength.compliance = 1. / strength.stiffness;
    sigma = add_mean(s, Number(flow_rule.attraction - strength.stiffness));
  }



  /// Elastic moduli of point(s), Pa, in a step of the volumetric strain
  /// @p volume [-].
  template <typename FlowRule, typename Strength, typename Number>
  TALUS_ALWAYS_INLINE auto
  moduli_of_step(const Moduli                  &moduli_of_law,
                 const FlowRule                &flow_rule,
                 const PointStrength<Strength> &strength,
                 const Number                  &volume)
  {
    const auto moduli = moduli_of_point(moduli_of_law, strength);
    if constexpr (is_stiffened_by_pressure<FlowRule>)
      return ModuliOf<Number>{moduli.lambda,
                              moduli.mu,
                              flow_rule.bulk_modulus(strength.stiffness,
                                                     volume)};
    else
      return moduli;
  }



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
    auto sigma     = load_stress<dim, Number>(step.points, p);
    trial.strength = step.strength(p, Number());
    if constexpr (is_stiffened_by_pressure<FlowRule>)
      stiffen<dim>(step.flow_rule,
                   softening<Number>(step, p),
                   trial.strength,
                   sigma);
    trial.moduli     = moduli_of_step(step.moduli,
                                  step.flow_rule,
                                  trial.strength,
                                  trial.strain.volumetric);
    trial.compliance = 1. / step.moduli.mu * trial.strength.compliance;
    trial.stress =
      elastic_trial<dim, Number>(sigma, trial.strain, trial.moduli);
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
          if (!all(softening<Number>(step, p) >= 0.))
            return false;
      }
    return all(trial.motion.volume_after > 0.);
  }
} // namespace talus

#endif
