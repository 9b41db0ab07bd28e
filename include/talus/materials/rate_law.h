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
  /// by plastic flow at constant volume along the deviator, see
  /// return_radially(). A law is given by its @p FlowRule, a trivially copyable
  /// structure of the constants in its formula, with
  ///   Flow<Number>
  ///   operator()(const std::array<Number, n> &deviator,
  ///              const Variable              &plastic,
  ///              const Factor                &strength_factor) const,
  /// for the trial deviator, Pa, the plastic variable before the step and the
  /// strength factor. In the explicit step Number and Variable hold several
  /// points at once, Factor too unless it is NoStrengthFactor; in static stages
  /// Number is Dual or double, Variable and Factor are double. NoFlow is for
  /// elastic laws. An iterative rule may overload update_rate_law_points(). The
  /// functions of RateLaw are in rate_law.templates.h, to be included by the
  /// .cc file of a law.
  template <int dim, typename FlowRule>
  class RateLaw : public ElasticLaw<dim>
  {
  public:
    static constexpr bool is_plastic = !std::is_same_v<FlowRule, NoFlow>;

    /// Construct the law. @p plastic_variable is the name of the column of the
    /// internal variable [-]; empty for elastic laws.
    RateLaw(const std::string &section,
            const std::string &plastic_variable = "");

    /// Throw ExcUser also if the strength is negative or, with a stiffness
    /// ratio, zero.
    void
    check() const override;

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

    double
    largest_shear_modulus(const Points<dim> &points,
                          unsigned int       begin,
                          unsigned int       end) const override;

    const UndrainedStrength *
    undrained_strength() const override
    {
      return is_plastic ? &strength_ : nullptr;
    }

    bool
    is_hyperelastic() const override
    {
      return false;
    }

    /// Return true for plastic laws: flow keeps the volume for any Poisson's
    /// ratio.
    bool
    is_nearly_incompressible() const override
    {
      return is_plastic || ElasticLaw<dim>::is_nearly_incompressible();
    }

    bool
    has_strength() const override
    {
      return is_plastic;
    }

  protected:
    /// Declare the parameters of the strength of undisturbed soil; @p sentence
    /// documents the strength.
    void
    declare_strength(const std::string &sentence);

    /// Strength of undisturbed soil, Pa; 1 Pa if given by a column.
    double
    strength() const
    {
      return strength_.of_flow_rule();
    }

    /// Strength of undisturbed soil at point @p p, Pa.
    double
    strength(const Points<dim> &points, const unsigned int p) const
    {
      return this->has_strength_column() ? points.data(strength_column_)[p]
                                         : strength();
    }

    /// Return whether moduli are proportional to the strength of each point;
    /// moduli() then belongs to a strength of 1 Pa.
    bool
    has_moduli_of_points() const
    {
      return this->has_strength_column() && !stiffness_ratio_.empty();
    }

    /// Young's modulus, Pa, from the ratio E/s_u if given.
    double
    young_modulus() const override
    {
      return stiffness_ratio_.empty() ? ElasticLaw<dim>::young_modulus()
                                      : stiffness_ratio_.front() * strength();
    }

    /// Plastic variable of point @p p [-]; 0 for elastic laws.
    double
    plastic_variable(const Points<dim> &points, const unsigned int p) const
    {
      return is_plastic ? points.data(plastic_variable_)[p] : 0.;
    }

  private:
    /// Flow rule for a step of @p dt seconds; infinite for load steps, which
    /// are infinitely slow.
    virtual FlowRule
    flow_rule(double dt) const = 0;

    StrengthColumns
    strength_columns() const;
    auto
    moduli_in_load_step(const Points<dim> &points) const;
    auto
    flow_in_load_step(const Points<dim> &points) const;

    std::string       name_of_plastic_variable_;
    unsigned int      plastic_variable_ = dealii::numbers::invalid_unsigned_int;
    unsigned int      strength_column_  = dealii::numbers::invalid_unsigned_int;
    UndrainedStrength strength_{"2500"};
    // A single number, or empty if the parameter is not given.
    std::vector<double> stiffness_ratio_;
  };
} // namespace talus

#endif
