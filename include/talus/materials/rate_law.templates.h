// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_templates_h
#define talus_materials_rate_law_templates_h

#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/materials/inverted_point.h>
#include <talus/materials/load_step.h>
#include <talus/materials/rate_law.h>
#include <talus/materials/rate_law_kernel.h>
#include <talus/materials/strength_factor.h>

#include <algorithm>
#include <limits>

namespace talus
{
  /// Length of a load step of the static stages, s.
  inline constexpr double infinitely_slow =
    std::numeric_limits<double>::infinity();



  /// Implement MaterialModel::linearize() for laws in rate form: @p moduli_at
  /// maps a point to its moduli, @p flow a point and its trial stress to a
  /// Flow. Returns false if a point is inverted.
  template <int dim, typename ModuliAt, typename FlowRule>
  inline bool
  linearize_rate_law(const Points<dim>        &points,
                     const StepWorkspace<dim> &workspace,
                     const unsigned int        begin,
                     const unsigned int        end,
                     const StrainMeasure       measure,
                     const ModuliAt           &moduli_at,
                     StressTangent<dim>       *linearization,
                     const FlowRule           &flow)
  {
    using Number    = Dual<dim * dim>;
    const auto work = workspace.view(begin, end);
    for (unsigned int p = begin; p < end; ++p)
      {
        const auto   H          = load_independent_gradient(work, p);
        const Number dilatation = determinant_increment(H);
        if (measure == StrainMeasure::large && !(dilatation.value > -1.))
          return false;
        const auto          strain = strain_of_load_step(H, measure);
        const auto          before = load_stress<dim, double>(points, p);
        Stress<dim, Number> sigma;
        std::copy(before.begin(), before.end(), sigma.begin());

        const auto   trial = elastic_trial<dim>(sigma, strain, moduli_at(p));
        const auto   flow_here = flow(p, trial);
        const Number removed   = flow_here.removed;
        auto         deviator  = trial.deviator_after;
        for (Number &component : deviator)
          component *= 1. - removed;
        sigma =
          add_mean(turn(strain.half_rotation, deviator),
                   trial.mean_after - moduli_at(p).bulk * flow_here.dilation);
        if (measure == StrainMeasure::large)
          for (Number &component : sigma)
            component *= 1. + dilatation;
        store_nominal(sigma, H, measure, linearization[p - begin]);
      }
    return true;
  }



  template <int dim, typename FlowRule>
  RateLaw<dim, FlowRule>::RateLaw(const std::string &section,
                                  const std::string &plastic_variable)
    : ElasticLaw<dim>(section)
    , name_of_plastic_variable_(plastic_variable)
  {}



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::add_columns(Points<dim> &points)
  {
    if (is_plastic)
      plastic_variable_ = points.add_column(name_of_plastic_variable_,
                                            "-",
                                            1,
                                            Inheritance::copied);
  }



  template <int dim, typename FlowRule>
  StrengthColumns
  RateLaw<dim, FlowRule>::strength_columns() const
  {
    return {this->strength_factor(),
            dealii::numbers::invalid_unsigned_int,
            false};
  }



  /// Call @p action with the strength factor of the points, as
  /// with_point_strength() does; elastic laws have no strength.
  template <int dim, typename FlowRule>
  template <typename Action>
  void
  RateLaw<dim, FlowRule>::with_strength(
    [[maybe_unused]] const Points<dim> &points, const Action &action) const
  {
    if constexpr (is_plastic)
      with_point_strength(points, strength_columns(), action);
    else
      action(no_strength_factor);
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::update_stress(Points<dim>              &points,
                                        const StepWorkspace<dim> &workspace,
                                        const unsigned int        begin,
                                        const unsigned int        end,
                                        const double              dt) const
  {
    update_stress_by(flow_rule(dt), points, workspace, begin, end, dt);
  }



  template <int dim, typename FlowRule>
  template <typename Rule>
  void
  RateLaw<dim, FlowRule>::update_stress_by(const Rule               &rule,
                                           Points<dim>              &points,
                                           const StepWorkspace<dim> &workspace,
                                           const unsigned int        begin,
                                           const unsigned int        end,
                                           const double              dt) const
  {
    TalusAssert(!is_plastic ||
                  plastic_variable_ != dealii::numbers::invalid_unsigned_int,
                dealii::ExcMessage("add_columns() was not called."));
    const Moduli       moduli    = this->moduli();
    const Rule         flow      = rule;
    const auto         columns   = points.view();
    const auto         work      = workspace.view(begin, end);
    const unsigned int plastic   = plastic_variable_;
    const unsigned int softening = strength_columns().band.softening;
    bool               is_sound  = true;
    with_strength(points, [&](const auto &factor) {
      // Constructed here, not captured, so that the compiler knows all values.
      const RateLawStep<dim, Rule> step = {
        columns, work, plastic, dt, moduli, flow, softening};
      constexpr unsigned int n    = n_registers_at_once<Rule>;
      unsigned int           rest = begin;
      if constexpr (n > 1)
        for (; rest + n * simd_width <= end; rest += n * simd_width)
          is_sound &= update_rate_law_points<dim, Simd<simd_width>, n>(step,
                                                                       rest,
                                                                       factor);
      for_each_simd(
        rest, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
          is_sound &=
            update_rate_law_points<dim, decltype(number), 1>(step, p, factor);
        });
    });
    if (is_sound)
      return;
    throw_inverted_point(points,
                         begin,
                         end,
                         this->largest_shear_modulus(points, begin, end),
                         this->submerged_density());
    if constexpr (is_plastic)
      throw_unsolved_point(points, begin, end, plastic_variable_);
  }



  /// Return a function that maps a point to its moduli.
  template <int dim, typename FlowRule>
  auto
  RateLaw<dim, FlowRule>::moduli_in_load_step(const Points<dim> &points) const
  {
    return [&points, columns = strength_columns(), moduli = this->moduli()](
             const unsigned int p) {
      return columns.stiffness_follows
               ? moduli_of_point(moduli,
                                 PointStrength<double>{
                                   1., 1., points.data(columns.strength)[p]})
               : moduli;
    };
  }



  /// Return a function that maps a point and its trial stress to the flow in
  /// a load step.
  template <int dim, typename FlowRule>
  auto
  RateLaw<dim, FlowRule>::flow_in_load_step(const Points<dim> &points) const
  {
    return [this,
            &points,
            columns = strength_columns(),
            rule    = flow_rule(infinitely_slow)](const unsigned int p,
                                               const auto        &trial) {
      const double plastic = this->plastic_variable(points, p);
      const double factor  = this->strength_factor(points, p);
      if constexpr (is_plastic)
        if (const auto &band = columns.band;
            band.softening != dealii::numbers::invalid_unsigned_int)
          return rule(trial,
                      points.data(band.softening)[p],
                      band_strength(points, columns)(p, double()));
      if constexpr (is_plastic)
        if (columns.strength != dealii::numbers::invalid_unsigned_int)
          {
            const double strength = points.data(columns.strength)[p];
            return rule(trial,
                        plastic,
                        PointStrength<double>{factor,
                                              strength,
                                              columns.stiffness_follows
                                                ? strength
                                                : 1.});
          }
      return rule(trial, plastic, factor);
    };
  }



  template <int dim, typename FlowRule>
  bool
  RateLaw<dim, FlowRule>::linearize(const Points<dim>        &points,
                                    const StepWorkspace<dim> &workspace,
                                    const unsigned int        begin,
                                    const unsigned int        end,
                                    const StrainMeasure       measure,
                                    StressTangent<dim> *linearization) const
  {
    return linearize_rate_law(points,
                              workspace,
                              begin,
                              end,
                              measure,
                              moduli_in_load_step(points),
                              linearization,
                              flow_in_load_step(points));
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::commit_load_step(Points<dim>              &points,
                                           const StepWorkspace<dim> &workspace,
                                           const unsigned int        begin,
                                           const unsigned int        end,
                                           const StrainMeasure measure) const
  {
    const auto         columns   = points.view();
    const auto         work      = workspace.view(begin, end);
    const Moduli       moduli    = this->moduli();
    const FlowRule     rule      = flow_rule(infinitely_slow);
    const unsigned int softening = strength_columns().band.softening;
    with_strength(points, [&](const auto &factor) {
      for (unsigned int p = begin; p < end; ++p)
        {
          Motion<dim, double> motion;
          if (measure == StrainMeasure::large)
            motion = advance_edges<dim, double>(columns, work, p, 1.);
          else
            {
              motion.increment = load_velocity_gradient<dim, double>(work, p);
              motion.volume_before = motion.volume_after =
                volume_of_points<dim, double>(points, p);
            }
          const auto strain = strain_of_load_step(motion.increment, measure);
          const auto factor_here = factor(p, double());
          const auto moduli_here = moduli_of_point(moduli, factor_here);
          const RateLawTrial<dim, double, double> trial = {
            motion,
            strain,
            moduli_here,
            elastic_trial<dim, double>(load_stress<dim, double>(points, p),
                                       strain,
                                       moduli_here)};
          const auto flow =
            rule(trial.stress,
                 softening_variable<std::decay_t<decltype(factor_here)>>(
                   columns, softening, p, plastic_variable(points, p)),
                 factor_here);
          if constexpr (is_plastic)
            points.data(plastic_variable_)[p] += flow.increment;
          soften(columns, softening, p, flow.increment, factor_here);
          flow_plastically(columns, p, trial, flow);
        }
    });
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::wave_modulus(const Points<dim> & /*points*/,
                                       const unsigned int begin,
                                       const unsigned int end,
                                       double            *modulus) const
  {
    std::fill_n(modulus, end - begin, this->moduli().longitudinal());
  }
} // namespace talus

#endif
