// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_strength_reduction_h
#define talus_equilibrium_strength_reduction_h

#include <talus/equilibrium/equilibrium.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <string>

namespace talus
{
  /// Factor of safety: the largest number by which all strengths can be divided
  /// with the soil still in balance, by shear strength reduction.
  /// @cite griffiths1999 The factor is less than 1 if the soil needs more
  /// strength to stand. Trial factors that grow or fall by a half give a
  /// bracket, which is then bisected. Failure of the soil counts only after the
  /// soil stood with nearly the same factor, as a larger reduction may be too
  /// large for one trial.
  class StrengthReduction : public dealii::ParameterAcceptor
  {
  public:
    StrengthReduction();

    /// Throw ExcUser if the limits of the factor contradict each other.
    void
    check() const;

    /// Start a new search. No strength may be multiplied by more than
    /// @p largest_strength [-].
    void
    begin(double largest_strength);

    /// Return whether the bracket is narrow enough, with an upper end tried
    /// from within the tolerance, or has reached the limits of the factor.
    bool
    is_done() const;

    /// Factor to try next [-].
    double
    next() const;

    /// Record whether the soil stands with its strength divided by @p factor.
    void
    record(double factor, bool stands);

    /// Record that @p factor is the largest of the path of decreasing strength.
    void
    record_limit(const double factor)
    {
      lower_ = upper_ = upper_from_ = factor;
    }

    /// Describe the result in one or two sentences.
    std::string
    result() const;

    /// Largest factor with which the soil stood; 0 if unknown.
    double
    lower() const
    {
      return lower_;
    }

    /// Smallest factor above lower() with which the soil failed; 0 if unknown.
    double
    upper() const
    {
      return upper_;
    }

    /// Factor of safety: the middle of the bracket, or its only known end.
    double
    factor() const
    {
      return (lower_ + upper_) * (lower_ > 0. && upper_ > 0. ? 0.5 : 1.);
    }

    /// Return whether the soil is known to fail with its actual strength.
    bool
    is_less_than_one() const
    {
      return upper_ > 0. && upper_ <= 1.;
    }

    /// Options of the search for equilibrium with @p factor, derived from
    /// @p options of section Equilibrium. If the soil stands with a smaller
    /// factor, the load is applied in one step, which is halved at most to the
    /// smallest load step of this section. If the factor is within the
    /// tolerance, where failure decides, the smallest load step of section
    /// Equilibrium applies.
    StaticOptions
    options(double factor, StaticOptions options) const;

    /// Return whether the strength of the seabed is divided, too.
    bool
    includes_seabed() const
    {
      return includes_seabed_;
    }

  private:
    double
    min_factor() const
    {
      // Strengths may not be raised beyond the limit of the law: softening soil
      // would soften faster than it can unload (doc/method.md, section 12).
      return std::max(smallest_, 1. / largest_strength_);
    }
    bool
    is_narrow() const
    {
      // Both ends of the bracket must be known.
      return upper_ - lower_ <= tolerance_ * lower_;
    }

    // Parameters
    double first_             = 1.;
    double tolerance_         = 0.005;
    double largest_           = 100.;
    double smallest_          = 0.01;
    double smallest_step_     = 0.1;
    double allowed_imbalance_ = 0.;
    bool   includes_seabed_   = true;

    double lower_ = 0, upper_ = 0;
    double upper_from_       = 0; ///< lower_ when upper_ failed
    double growth_           = 0; ///< next growth of lower_ without upper_ [-]
    double largest_strength_ = 0;
  };
} // namespace talus

#endif
