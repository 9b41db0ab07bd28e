// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_templates_h
#define talus_materials_rate_law_templates_h

#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/materials/inverted_point.h>
#include <talus/materials/load_step.h>
#include <talus/materials/rate_law.h>
#include <talus/materials/rate_law_kernel.h>

#include <algorithm>
#include <limits>

namespace talus
{
  /// Length of a load step of the static stages, s.
  inline constexpr double infinitely_slow =
    std::numeric_limits<double>::infinity();



  template <int dim, typename FlowRule>
  RateLaw<dim, FlowRule>::RateLaw(const std::string &section,
                                  const std::string &plastic_variable,
                                  const std::string &unit)
    : ElasticLaw<dim>(section, !is_stiffened_by_pressure<FlowRule>)
    , name_of_plastic_variable_(plastic_variable)
    , unit_of_plastic_variable_(unit)
  {}



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::add_columns(Points<dim> &points)
  {
    if (is_plastic)
      plastic_variable_ = points.add_column(name_of_plastic_variable_,
                                            unit_of_plastic_variable_,
                                            1,
                                            Inheritance::copied);
  }



  template <int dim, typename FlowRule>
  StrengthOfPoints
  RateLaw<dim, FlowRule>::strength_of(const Points<dim> &points) const
  {
    StrengthOfPoints strength;
    if (is_plastic &&
        this->strength_factor() != dealii::numbers::invalid_unsigned_int)
      strength.factor.column = points.data(this->strength_factor());
    strength.softening_column = plastic_variable_;
    return strength;
  }



  template <int dim, typename FlowRule>
  double
  RateLaw<dim, FlowRule>::softening(const Points<dim> &points,
                                    const unsigned int p) const
  {
    if constexpr (is_plastic)
      return points.data(strength_of(points).softening_column)[p];
    else
      return 0.;
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
    // Constructed here, not captured, so that the compiler knows all values.
    const RateLawStep<dim, Rule> step     = {points.view(),
                                             workspace.view(begin, end),
                                             plastic_variable_,
                                             dt,
                                             this->moduli(),
                                             rule,
                                             strength_of(points)};
    constexpr unsigned int       n        = n_registers_at_once<Rule>;
    unsigned int                 rest     = begin;
    bool                         is_sound = true;
    if constexpr (n > 1)
      for (; rest + n * simd_width <= end; rest += n * simd_width)
        is_sound &=
          update_rate_law_points<dim, Simd<simd_width>, n>(step, rest);
    for_each_simd(rest,
                  end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    is_sound &=
                      update_rate_law_points<dim, decltype(number), 1>(step, p);
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



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::linearize(const Points<dim>        &points,
                                    const StepWorkspace<dim> &workspace,
                                    const unsigned int        begin,
                                    const unsigned int        end,
                                    StressTangent<dim> *linearization) const
  {
    using Number                 = Dual<dim * dim>;
    const auto     work          = workspace.view(begin, end);
    const Moduli   moduli_of_law = this->moduli();
    const FlowRule rule          = flow_rule(infinitely_slow);
    const auto     strengths     = strength_of(points);
    for (unsigned int p = begin; p < end; ++p)
      {
        const auto strain =
          small_strain_increment(load_independent_gradient(work, p));
        auto before   = load_stress<dim, double>(points, p);
        auto strength = strengths(p, double());
        if constexpr (is_stiffened_by_pressure<FlowRule>)
          stiffen<dim>(rule, softening(points, p), strength, before);
        const auto moduli =
          moduli_of_step(moduli_of_law, rule, strength, strain.volumetric);
        Stress<dim, Number> sigma;
        std::copy(before.begin(), before.end(), sigma.begin());

        const auto   trial   = elastic_trial<dim>(sigma, strain, moduli);
        const auto   flow    = rule(trial, softening(points, p), strength);
        const Number removed = flow.removed;
        sigma                = trial.deviator_after;
        for (Number &component : sigma)
          component *= 1. - removed;
        linearization[p - begin] = stress_tangent<dim>(
          add_mean(sigma, trial.mean_after - moduli.bulk * flow.dilation));
      }
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::commit_load_step(Points<dim>              &points,
                                           const StepWorkspace<dim> &workspace,
                                           const unsigned int        begin,
                                           const unsigned int        end) const
  {
    const RateLawStep<dim, FlowRule> step = {points.view(),
                                             workspace.view(begin, end),
                                             plastic_variable_,
                                             1.,
                                             this->moduli(),
                                             flow_rule(infinitely_slow),
                                             strength_of(points)};
    for (unsigned int p = begin; p < end; ++p)
      {
        RateLawTrial<dim, double> trial;
        trial.motion.increment =
          load_velocity_gradient<dim, double>(step.workspace, p);
        trial.motion.volume_before = trial.motion.volume_after =
          volume_of_points<dim, double>(points, p);
        trial.strain = small_strain_increment(trial.motion.increment);
        set_trial_stress(step, p, trial);
        const auto flow =
          step.flow_rule(trial.stress, softening(points, p), trial.strength);
        if constexpr (is_plastic)
          soften(step, p, flow.increment, trial.strength);
        flow_plastically(step.points, p, trial, flow);
      }
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::wave_modulus(const Points<dim> & /*points*/,
                                       const unsigned int begin,
                                       const unsigned int end,
                                       double            *modulus) const
  {
    std::fill_n(modulus,
                end - begin,
                this->moduli().longitudinal() + this->pore_water().stiffness);
  }
} // namespace talus

#endif
