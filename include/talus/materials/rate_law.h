// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_h
#define talus_materials_rate_law_h

#include <talus/materials/elastic_law.h>

#include <type_traits>

namespace talus
{
  struct NoFlow;
  struct StrengthOfPoints;

  /// Base of laws in rate form: Hooke's law between the Jaumann rate of the
  /// Cauchy stress and the rate of deformation, see elastic_trial(), followed
  /// by plastic flow, see flow_plastically(). A law is given by its
  /// @p FlowRule, a trivially copyable structure of the constants in its
  /// formula, with
  ///   Flow<Number>
  ///   operator()(const StressStep<dim, Number> &trial,
  ///              const Strength                &softening,
  ///              const PointStrength<Strength> &strength) const,
  /// for the trial stress, Pa, the softening before the step (the plastic
  /// variable, unless the law has another) and the strength of the point. In
  /// the explicit step Number and Strength hold several points at once; in
  /// static stages Number is Dual or double, Strength is double. A rule that
  /// changes the mean stress returns Flow<Number, Number>. NoFlow is for
  /// elastic laws. An iterative rule may overload update_rate_law_points(). The
  /// functions of RateLaw are in rate_law.templates.h, to be included by the
  /// .cc file of a law.
  template <int dim, typename FlowRule>
  class RateLaw : public ElasticLaw<dim>
  {
  public:
    static constexpr bool is_plastic = !std::is_same_v<FlowRule, NoFlow>;

    /// Construct the law. @p plastic_variable is the name of the column of the
    /// internal variable, never negative, in @p unit; empty for elastic laws.
    RateLaw(const std::string &section,
            const std::string &plastic_variable = "",
            const std::string &unit             = "-");

    void
    add_columns(Points<dim> &points) override;

    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const override;

    void
    linearize(const Points<dim>        &points,
              const StepWorkspace<dim> &workspace,
              unsigned int              begin,
              unsigned int              end,
              StressTangent<dim>       *linearization) const override;

    void
    commit_load_step(Points<dim>              &points,
                     const StepWorkspace<dim> &workspace,
                     unsigned int              begin,
                     unsigned int              end) const override;

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
    /// Variable on which the strength of point @p p depends; 0 if elastic.
    double
    softening(const Points<dim> &points, const unsigned int p) const;

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

    /// Strength and stiffness of the points. Overrides complete the result of
    /// this function, which has the strength factor.
    virtual StrengthOfPoints
    strength_of(const Points<dim> &points) const;

  private:
    std::string  name_of_plastic_variable_, unit_of_plastic_variable_;
    unsigned int plastic_variable_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
