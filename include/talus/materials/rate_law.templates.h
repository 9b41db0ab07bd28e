// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_templates_h
#define talus_materials_rate_law_templates_h

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
  /// Implement MaterialModel::linearize() for laws in rate form: @p moduli_at
  /// maps a point to its moduli, @p flow a point and its trial deviator to a
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

        const auto   trial    = elastic_trial<dim>(sigma, strain, moduli_at(p));
        const Number removed  = flow(p, trial.deviator_after).removed;
        auto         deviator = trial.deviator_after;
        for (Number &component : deviator)
          component *= 1. - removed;
        sigma =
          add_mean(turn(strain.half_rotation, deviator), trial.mean_after);
        if (measure == StrainMeasure::large)
          for (Number &component : sigma)
            component *= 1. + dilatation;
        store_nominal(sigma, H, measure, linearization[p - begin]);
      }
    return true;
  }



  /// Implement MaterialModel::commit_load_step() for laws in rate form.
  /// @p plastic is the column of the plastic variable, or invalid_unsigned_int.
  template <int dim, typename ModuliAt, typename FlowRule>
  inline void
  commit_rate_law(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  const unsigned int        begin,
                  const unsigned int        end,
                  const StrainMeasure       measure,
                  const ModuliAt           &moduli_at,
                  const unsigned int        plastic,
                  const FlowRule           &flow)
  {
    const auto columns = points.view();
    const auto work    = workspace.view(begin, end);
    for (unsigned int p = begin; p < end; ++p)
      {
        Motion<dim, double> motion;
        if (measure == StrainMeasure::large)
          motion = advance_deformation<dim, double>(columns, work, p, 1.);
        else
          {
            motion.increment = load_velocity_gradient<dim, double>(work, p);
            motion.J_before = motion.J_after = determinant(
              load_matrix<dim, double>(points, points.deformation_gradient, p));
          }
        const auto   strain = strain_of_load_step(motion.increment, measure);
        const Moduli moduli = moduli_at(p);
        const auto   trial =
          elastic_trial<dim, double>(load_stress<dim, double>(points, p),
                                     strain,
                                     moduli);
        const Flow<double> plastic_flow = flow(p, trial.deviator_after);
        if (plastic != dealii::numbers::invalid_unsigned_int)
          points.data(plastic)[p] += plastic_flow.increment;
        return_radially<dim, double>(
          columns, p, motion, strain, trial, moduli.mu, plastic_flow.removed);
      }
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
    if (this->has_strength_column())
      strength_column_ = points.add_column("undrained shear strength",
                                           "Pa",
                                           1,
                                           Inheritance::copied);
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::check() const
  {
    ElasticLaw<dim>::check();
    const bool needs_strength = !stiffness_ratio_.empty();
    AssertThrow(strength() > 0. || (strength() == 0. && !needs_strength),
                ExcUser(text("Section ",
                             this->section(),
                             ": `Undrained shear strength` is ",
                             strength(),
                             " Pa. Give a positive number",
                             needs_strength
                               ? "; the stiffness is proportional to it."
                               : ", or 0.")));
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::declare_strength(const std::string &sentence)
  {
    using dealii::ParameterAcceptor;
    namespace Patterns = dealii::Patterns;
    this->add_parameter(
      "Undrained shear strength",
      strength_.words(),
      sentence +
        " A number, an expression in x, y (, z) and the depth below the "
        "mudline, as 2000 + 1500*depth, or 'table FILE': a CSV file with the "
        "columns 'depth [m]' and 'undrained shear strength [Pa]'. Place and "
        "depth [m] are taken at the start, without initial displacement; the "
        "strength moves with the soil.");
    this->add_parameter(
      "Stiffness ratio",
      stiffness_ratio_,
      "Young's modulus over the undrained shear strength of undisturbed soil, "
      "E/s_u [-], at each point; replaces `Young's modulus`. Empty: `Young's "
      "modulus` is used.",
      ParameterAcceptor::prm,
      Patterns::List(Patterns::Double(1e-12), 0, 1));
  }



  template <int dim, typename FlowRule>
  StrengthColumns
  RateLaw<dim, FlowRule>::strength_columns() const
  {
    return {this->strength_factor(),
            this->has_strength_column() ? strength_column_
                                        : dealii::numbers::invalid_unsigned_int,
            has_moduli_of_points()};
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::update_stress(Points<dim>              &points,
                                        const StepWorkspace<dim> &workspace,
                                        const unsigned int        begin,
                                        const unsigned int        end,
                                        const double              dt) const
  {
    Assert(!is_plastic ||
             plastic_variable_ != dealii::numbers::invalid_unsigned_int,
           dealii::ExcMessage("add_columns() was not called."));
    const Moduli       moduli   = this->moduli();
    const FlowRule     flow     = flow_rule(dt);
    const unsigned int plastic  = plastic_variable_;
    const auto         columns  = points.view();
    const auto         work     = workspace.view(begin, end);
    bool               is_sound = true;
    const auto         update   = [&](const auto &factor) {
      constexpr unsigned int n    = n_registers_at_once<FlowRule>;
      unsigned int           rest = begin;
      if constexpr (n > 1)
        for (; rest + n * simd_width <= end; rest += n * simd_width)
          is_sound &= update_rate_law_points<dim, Simd<simd_width>, n>(
            columns, work, rest, plastic, dt, moduli, flow, factor);
      for_each_simd(rest,
                    end,
                    [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                      is_sound &=
                        update_rate_law_points<dim, decltype(number), 1>(
                          columns, work, p, plastic, dt, moduli, flow, factor);
                    });
    };
    if constexpr (is_plastic)
      with_point_strength(points, strength_columns(), update);
    else
      update(no_strength_factor);
    if (is_sound)
      return;
    throw_inverted_point(points,
                         begin,
                         end,
                         this->largest_shear_modulus(points, begin, end));
    if constexpr (is_plastic)
      throw_unsolved_point(points, begin, end, plastic);
  }



  /// Return a function that maps a point to its moduli.
  template <int dim, typename FlowRule>
  auto
  RateLaw<dim, FlowRule>::moduli_in_load_step(const Points<dim> &points) const
  {
    return [this, &points, moduli = this->moduli()](const unsigned int p) {
      return has_moduli_of_points()
               ? moduli_of_point(moduli,
                                 PointStrength<double>{
                                   1., 1., points.data(strength_column_)[p]})
               : moduli;
    };
  }



  /// Return a function that maps a point and its trial deviator to the flow in
  /// a load step.
  template <int dim, typename FlowRule>
  auto
  RateLaw<dim, FlowRule>::flow_in_load_step(const Points<dim> &points) const
  {
    const double infinitely_slow = std::numeric_limits<double>::infinity();
    return [this, &points, rule = flow_rule(infinitely_slow)](
             const unsigned int p, const auto &deviator) {
      const double plastic = this->plastic_variable(points, p);
      const double factor  = this->strength_factor(points, p);
      if constexpr (is_plastic)
        if (this->has_strength_column())
          {
            const double strength = points.data(strength_column_)[p];
            return rule(deviator,
                        plastic,
                        PointStrength<double>{factor,
                                              strength,
                                              has_moduli_of_points() ? strength
                                                                     : 1.});
          }
      return rule(deviator, plastic, factor);
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
    commit_rate_law(points,
                    workspace,
                    begin,
                    end,
                    measure,
                    moduli_in_load_step(points),
                    plastic_variable_,
                    flow_in_load_step(points));
  }



  template <int dim, typename FlowRule>
  void
  RateLaw<dim, FlowRule>::wave_modulus(const Points<dim> &points,
                                       const unsigned int begin,
                                       const unsigned int end,
                                       double            *modulus) const
  {
    const double longitudinal = this->moduli().longitudinal();
    if (!has_moduli_of_points())
      std::fill_n(modulus, end - begin, longitudinal);
    else
      std::transform(points.data(strength_column_) + begin,
                     points.data(strength_column_) + end,
                     modulus,
                     [longitudinal](const double strength) {
                       return strength * longitudinal;
                     });
  }



  template <int dim, typename FlowRule>
  double
  RateLaw<dim, FlowRule>::largest_shear_modulus(const Points<dim> &points,
                                                const unsigned int begin,
                                                const unsigned int end) const
  {
    const double mu = this->moduli().mu;
    if (!has_moduli_of_points() || begin == end)
      return mu;
    const double *strength = points.data(strength_column_);
    return mu * *std::max_element(strength + begin, strength + end);
  }
} // namespace talus

#endif
