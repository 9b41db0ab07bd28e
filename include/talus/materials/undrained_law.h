// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_undrained_law_h
#define talus_materials_undrained_law_h

#include <talus/materials/rate_law.h>

#include <vector>

namespace talus
{
  /// Base of laws for clay sheared without drainage: flow at constant volume
  /// with the undrained shear strength of each point, a column. With a
  /// stiffness ratio the moduli of the law belong to a strength of 1 Pa. With a
  /// softening displacement the softening of the flow rule is the column
  /// "softening", 1 at that displacement. The rule has a function curve(), see
  /// VonMisesFlow. With a rate coefficient the rule is applied as
  /// RateDependentFlow<FlowRule>. The functions are in
  /// undrained_law.templates.h, to be included by the .cc file of a law.
  template <int dim, typename FlowRule>
  class UndrainedLaw : public RateLaw<dim, FlowRule>
  {
  public:
    /// Declare the parameters of the strength; @p sentence documents the
    /// strength of undisturbed soil, @p softening_strain is the parameter that
    /// a softening displacement replaces. See RateLaw for @p plastic_variable.
    UndrainedLaw(const std::string &section,
                 const std::string &plastic_variable,
                 const std::string &sentence,
                 const std::string &softening_strain);

    void
    check() const override;

    /// Throw ExcUser if a stiffness proportional to the strength would be zero,
    /// or if soil would soften faster than it can unload elastically.
    void
    check_strength(const StrengthRange &range) const override;

    double
    shear_strength(const Points<dim> &points, unsigned int p) const override;

    void
    add_columns(Points<dim> &points) override;

    /// Set also the strength, if it is a number for all points.
    void
    initialize(Points<dim> &points,
               unsigned int begin,
               unsigned int end) const override;

    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const override;

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
      return &strength_;
    }

    bool
    softens_by_displacement() const override
    {
      return !softening_displacement_.empty();
    }

    /// Return true: flow keeps the volume for any Poisson's ratio.
    bool
    is_nearly_incompressible() const override
    {
      return true;
    }

  protected:
    /// Strength of undisturbed soil at point @p p, Pa.
    double
    strength(const Points<dim> &points, const unsigned int p) const
    {
      return points.data(strength_column_)[p];
    }

    /// Return whether moduli are proportional to the strength of each point;
    /// moduli() then belongs to a strength of 1 Pa.
    bool
    has_moduli_of_points() const
    {
      return !stiffness_ratio_.empty();
    }

    /// Displacement across a shear band at which softening is 1, m; only if
    /// softens_by_displacement().
    double
    softening_displacement() const
    {
      return softening_displacement_.front();
    }

    /// Throw ExcUser if @p is_given, for a softening displacement beside the
    /// parameter @p other.
    void
    check_softening_is_given_once(bool               is_given,
                                  const std::string &other) const;

    bool
    has_rate_effect() const
    {
      return rate_coefficient_ > 0.;
    }

    /// Factor by which the rate of shearing steepens the softening in the
    /// return of a step [-]: R + 2 m at the highest rate, 1 without a rate
    /// effect. See plastic_increment().
    double
    steepening_by_rate() const;

    /// Young's modulus, Pa; with a stiffness ratio per Pa of strength.
    double
    young_modulus() const override
    {
      return has_moduli_of_points() ? stiffness_ratio_.front()
                                    : ElasticLaw<dim>::young_modulus();
    }

  private:
    /// Plastic shear strain in simple shear per plastic variable [-].
    virtual double
    shear_per_plastic_variable() const = 0;

    /// Return the parameter, in words, that slows softening down by @p times.
    virtual std::string
    slower_softening(double times) const = 0;

    StrengthOfPoints
    strength_of(const Points<dim> &points) const override;

    unsigned int      strength_column_ = dealii::numbers::invalid_unsigned_int;
    UndrainedStrength strength_{"2500"};
    // A single number, or empty if the parameter is not given.
    std::vector<double> stiffness_ratio_, softening_displacement_;
    double              rate_coefficient_ = 0., reference_rate_ = 3e-6;
    unsigned int softening_column_ = dealii::numbers::invalid_unsigned_int;
    unsigned int cell_size_column_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
