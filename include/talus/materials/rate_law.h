// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_rate_law_h
#define talus_materials_rate_law_h

#include <talus/materials/elastic_law.h>

#include <type_traits>

namespace talus
{
  struct NoFlow;
  struct StrengthColumns;

  /// A law in rate form: Hooke's law between the Jaumann rate of the Cauchy
  /// stress and the rate of deformation, see elastic_trial(), and then plastic
  /// flow at constant volume along the deviator, see return_radially(). All
  /// that differs from law to law is its @p FlowRule, a trivially copyable
  /// structure of the numbers in its formula:
  ///   Flow<Number>
  ///   operator()(const std::array<Number, n> &deviator,
  ///              const Variable              &plastic,
  ///              const Factor                &strength_factor) const,
  /// with the trial deviator, Pa, the plastic variable before the step and the
  /// strength factor. The explicit step calls it with Number and Variable
  /// several points at once and Factor the same or NoStrengthFactor, the static
  /// stages with Dual or double and the others double. NoFlow if the law is
  /// elastic. A rule that iterates may overload update_rate_law_points(). The
  /// functions of this class are in rate_law.templates.h, which the law's .cc
  /// includes.
  template <int dim, typename FlowRule>
  class RateLaw : public ElasticLaw<dim>
  {
  public:
    static constexpr bool is_plastic = !std::is_same_v<FlowRule, NoFlow>;

    /// @p plastic_variable is the name of the column of the internal variable
    /// [-]; elastic laws have none.
    RateLaw(const std::string &section,
            const std::string &plastic_variable = "");

    /// Throws ExcUser if a number of the strength is negative, too.
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

    /// Plastic flow keeps the volume whatever Poisson's ratio is.
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
    /// The entries that say how strong undisturbed soil is, @p sentence that of
    /// the strength.
    void
    declare_strength(const std::string &sentence);

    /// The strength of undisturbed soil, Pa; 1 Pa if it stands in a column.
    double
    strength() const
    {
      return strength_.of_flow_rule();
    }

    /// That of point @p p, Pa.
    double
    strength(const Points<dim> &points, const unsigned int p) const
    {
      return this->has_strength_column() ? points.data(strength_column_)[p]
                                         : strength();
    }

    /// True if moduli are in proportion to the strength of each point; those of
    /// moduli() then belong to a strength of 1 Pa.
    bool
    has_moduli_of_points() const
    {
      return this->has_strength_column() && !stiffness_ratio_.empty();
    }

    /// From the ratio E/s_u if that is given.
    double
    young_modulus() const override
    {
      return stiffness_ratio_.empty() ? ElasticLaw<dim>::young_modulus()
                                      : stiffness_ratio_.front() * strength();
    }

    /// The plastic variable of point @p p; 0 if there is none.
    double
    plastic_variable(const Points<dim> &points, const unsigned int p) const
    {
      return is_plastic ? points.data(plastic_variable_)[p] : 0.;
    }

  private:
    /// That of a step of @p dt seconds; of a load step, which is infinitely
    /// slow, dt is infinite.
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
    // One number, or none where the user gave nothing.
    std::vector<double> stiffness_ratio_;
  };
} // namespace talus

#endif
