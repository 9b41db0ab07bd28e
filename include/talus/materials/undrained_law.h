// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_undrained_law_h
#define talus_materials_undrained_law_h

#include <talus/materials/rate_law.h>

#include <vector>

namespace talus
{
  /// Base of laws for clay sheared without drainage: flow at constant volume
  /// with an undrained shear strength, which may differ from point to point.
  /// The flow rule takes strength() and moduli(), and multiplies both by
  /// share_of_strength() and modulus_of_point(). The functions are in
  /// undrained_law.templates.h, to be included by the .cc file of a law.
  template <int dim, typename FlowRule>
  class UndrainedLaw : public RateLaw<dim, FlowRule>
  {
  public:
    /// Declare the parameters of the strength; @p sentence documents the
    /// strength of undisturbed soil. See RateLaw for @p plastic_variable.
    UndrainedLaw(const std::string &section,
                 const std::string &plastic_variable,
                 const std::string &sentence);

    /// Throw ExcUser also if the strength is negative or, with a stiffness
    /// ratio, zero.
    void
    check() const override;

    void
    add_columns(Points<dim> &points) override;

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

    /// Return true: flow keeps the volume for any Poisson's ratio.
    bool
    is_nearly_incompressible() const override
    {
      return true;
    }

  protected:
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

  private:
    StrengthColumns
    strength_columns() const override;

    unsigned int      strength_column_ = dealii::numbers::invalid_unsigned_int;
    UndrainedStrength strength_{"2500"};
    // A single number, or empty if the parameter is not given.
    std::vector<double> stiffness_ratio_;
  };
} // namespace talus

#endif
