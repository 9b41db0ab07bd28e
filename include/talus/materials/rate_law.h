// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_h
#define talus_materials_rate_law_h

#include <talus/materials/elastic_law.h>

#include <type_traits>

namespace talus
{
  struct NoFlow;
  struct StrengthColumns;

  /// Base of laws in rate form: Hooke's law between the Jaumann rate of the
  /// Cauchy stress and the rate of deformation, see elastic_trial(), followed
  /// by plastic flow, see flow_plastically(). A law is given by its
  /// @p FlowRule, a trivially copyable structure of the constants in its
  /// formula, with
  ///   Flow<Number>
  ///   operator()(const StressStep<dim, Number> &trial,
  ///              const Variable                &plastic,
  ///              const Factor                  &strength_factor) const,
  /// for the trial stress, Pa, the plastic variable before the step and the
  /// strength factor. In the explicit step Number and Variable hold several
  /// points at once, Factor too unless it is NoStrengthFactor; in static stages
  /// Number is Dual or double, Variable is double. A rule that changes the mean
  /// stress returns Flow<Number, Number>. NoFlow is for elastic laws. An
  /// iterative rule may overload update_rate_law_points(). The functions of
  /// RateLaw are in rate_law.templates.h, to be included by the .cc file of a
  /// law.
  template <int dim, typename FlowRule>
  class RateLaw : public ElasticLaw<dim>
  {
  public:
    static constexpr bool is_plastic = !std::is_same_v<FlowRule, NoFlow>;

    /// Construct the law. @p plastic_variable is the name of the column of the
    /// internal variable [-]; empty for elastic laws.
    RateLaw(const std::string &section,
            const std::string &plastic_variable = "");

    void
    add_columns(Points<dim> &points) override;

    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const override;

    bool
    linearize(const Points<dim>        &points,
              const StepWorkspace<dim> &workspace,
              unsigned int              begin,
              unsigned int              end,
              StrainMeasure             measure,
              StressTangent<dim>       *linearization) const override;

    void
    commit_load_step(Points<dim>              &points,
                     const StepWorkspace<dim> &workspace,
                     unsigned int              begin,
                     unsigned int              end,
                     StrainMeasure             measure) const override;

    void
    wave_modulus(const Points<dim> &points,
                 unsigned int       begin,
                 unsigned int       end,
                 double            *modulus) const override;

    bool
    is_hyperelastic() const override
    {
      return false;
    }

    bool
    has_strength() const override
    {
      return is_plastic;
    }

  protected:
    /// Plastic variable of point @p p [-]; 0 for elastic laws.
    double
    plastic_variable(const Points<dim> &points, const unsigned int p) const
    {
      return is_plastic ? points.data(plastic_variable_)[p] : 0.;
    }

    /// Flow rule for a step of @p dt seconds; infinite for load steps, which
    /// are infinitely slow.
    virtual FlowRule
    flow_rule(double dt) const = 0;

    /// Implement update_stress() with @p rule as flow rule.
    template <typename Rule>
    void
    update_stress_by(const Rule               &rule,
                     Points<dim>              &points,
                     const StepWorkspace<dim> &workspace,
                     unsigned int              begin,
                     unsigned int              end,
                     double                    dt) const;

  private:
    /// Columns by which strength and stiffness differ from point to point.
    virtual StrengthColumns
    strength_columns() const;

    auto
    moduli_in_load_step(const Points<dim> &points) const;
    auto
    flow_in_load_step(const Points<dim> &points) const;

    template <typename Action>
    void
    with_strength(const Points<dim> &points, const Action &action) const;

    std::string  name_of_plastic_variable_;
    unsigned int plastic_variable_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
