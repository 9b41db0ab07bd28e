// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_strength_reduction_h
#define talus_equilibrium_strength_reduction_h

#include <talus/equilibrium/equilibrium.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// The factor of safety by shear strength reduction: the largest number that
  /// all strengths can be divided by with the soil still in balance
  /// @cite griffiths1999; less than 1 where it takes more strength to stand. It
  /// is bracketed by factors that grow or fall by a half, then by bisection.
  /// That the soil fails counts only if it stood with nearly that factor: a
  /// larger reduction may fail because it is too large for one trial.
  class StrengthReduction : public dealii::ParameterAcceptor
  {
  public:
    StrengthReduction();

    /// Throw ExcUser if the limits of the factor contradict each other.
    void
    check() const;

    /// Nothing is known yet. No strength may be multiplied by more than
    /// @p largest_strength.
    void
    begin(double largest_strength);

    /// Whether the bracket is narrow enough, and its upper end tried from within
    /// the tolerance; or whether it ends at the limits.
    bool
    is_done() const;

    /// The factor to try next.
    double
    next() const;

    /// Whether the soil stands with its strength divided by @p factor.
    void
    record(double factor, bool stands);

    /// The result as a sentence or two.
    std::string
    result() const;

    /// The largest factor with which the soil stood, 0 if there is none.
    double
    lower() const
    {
      return lower_;
    }

    /// The smallest one beyond that with which it did not, 0 if there is none.
    double
    upper() const
    {
      return upper_;
    }

    /// Whether the soil is known to fail with the strength that it has.
    bool
    is_less_than_one() const
    {
      return upper_ > 0. && upper_ <= 1.;
    }

    /// For the trial of @p factor, made of those of the section Equilibrium.
    /// Soil that is known to stand with a smaller factor is loaded in one step,
    /// which is cut down to the smallest one of this section; within the
    /// tolerance, where failure decides, down to that of the equilibrium.
    EquilibriumLimits
    limits(double factor, EquilibriumLimits limits) const;

    /// Whether the strength of the seabed is divided, too.
    bool
    includes_seabed() const
    {
      return includes_seabed_;
    }

  private:
    double
    least_factor() const;
    bool
    is_narrow() const;

    // Parameters
    double first_             = 1.;
    double tolerance_         = 0.005;
    double largest_           = 100.;
    double smallest_          = 0.01;
    double smallest_step_     = 0.1;
    double allowed_imbalance_ = 0.;
    bool   includes_seabed_   = true;

    double lower_ = 0, upper_ = 0;
    double upper_from_       = 0; ///< lower end when the upper one failed
    double growth_           = 0; ///< of the next factor without upper end
    double largest_strength_ = 0;
  };
} // namespace talus

#endif
