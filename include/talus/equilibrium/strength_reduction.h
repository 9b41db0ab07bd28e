// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_strength_reduction_h
#define talus_equilibrium_strength_reduction_h

#include <talus/equilibrium/equilibrium.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Factor of safety: the largest number by which all strengths can be divided
  /// with the soil still in balance, by shear strength reduction
  /// @cite griffiths1999. The factor is less than 1 if the soil needs more
  /// strength to stand. Factors fall until the soil stands; from there the path
  /// of decreasing strength is followed: by steps of the factor while they
  /// succeed, then by steps of given length, whose factor is an unknown.
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

    /// Return whether the path has come to its limit, or the factors to theirs.
    bool
    is_done() const
    {
      return is_done_ ||
             (lower_ == 0. && upper_ > 0. && upper_ <= min_factor());
    }

    /// Factor to try next with the full load, until the soil stands [-].
    double
    next() const
    {
      return std::max(upper_ > 0. ? upper_ / 1.5 : first_, min_factor());
    }

    /// Record whether the soil stands with its strength divided by @p factor.
    /// If it stands, the path begins here.
    void
    record(double factor, bool stands);

    /// Path of decreasing strength, with the step to take next.
    StrengthPath &
    path()
    {
      return path_;
    }

    /// Record whether the next step of the path was found, and plan the next:
    /// steps found in few iterations grow.
    void
    record_step(bool is_found, unsigned int n_iterations);

    /// Describe the result in one or two sentences.
    std::string
    result() const;

    /// Largest factor with which the soil stood; 0 if unknown.
    double
    lower() const
    {
      return lower_;
    }

    /// Smallest factor above lower() with which the soil failed, or lower() if
    /// the path has come to its limit; 0 if unknown.
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

    /// Options of the search for equilibrium with a factor, derived from
    /// @p options of section Equilibrium. Soil that stands with a smaller
    /// factor takes the change in one step.
    StaticOptions
    options(StaticOptions options) const;

    /// Return whether the strength of the seabed is divided, too.
    bool
    includes_seabed() const
    {
      return includes_seabed_;
    }

    /// Return whether soil whose plastic flow is not associated is replaced by
    /// soil with associated flow and less strength @cite davis1968.
    bool
    is_associated() const
    {
      return flow_ == "Davis";
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
    is_past_limit(const double factor) const
    {
      return factor < (1. - tolerance_) * lower_;
    }
    void
    shorten_step();
    double
    change_by_doubling() const;

    // Parameters
    double first_             = 1.;
    double tolerance_         = 0.001;
    double largest_           = 100.;
    double smallest_          = 0.01;
    double allowed_imbalance_ = 0.;
    bool   includes_seabed_   = true;

    std::string flow_ = "as given";

    double       lower_ = 0, upper_ = 0;
    double       largest_strength_ = 0;
    StrengthPath path_;
    double growth_ = 0; ///< largest ratio of a step to the previous one [-]
    unsigned int n_failures_   = 0; ///< one after the other
    double       lower_before_ = 0; ///< lower_ before n_idle_ steps
    unsigned int n_idle_       = 0; ///< steps that did not raise the factor
    bool         is_done_      = false;
    /// Displacement, m, and factor [-] after the steps so far.
    std::vector<std::pair<double, double>> places_;
  };
} // namespace talus

#endif
