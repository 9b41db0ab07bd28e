#ifndef talus_equilibrium_strength_reduction_h
#define talus_equilibrium_strength_reduction_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// The factor of safety by shear strength reduction: the largest number that
  /// all strengths can be divided by with the soil still in balance
  /// @cite griffiths1999. It is bracketed by factors that grow or fall by a half,
  /// then by bisection.
  class StrengthReduction : public dealii::ParameterAcceptor
  {
  public:
    StrengthReduction();

    /// Nothing is known yet.
    void
    begin();

    /// Whether the bracket is narrow enough, or ends at the limits.
    bool
    is_done() const;

    /// The factor to try next.
    double
    next() const;

    /// Whether the soil stands with its strength divided by @p factor.
    void
    heed(double factor, bool stands);

    /// The result as a sentence.
    std::string
    result() const;

    /// The largest factor with which the soil stood, 0 if there is none.
    double
    lower() const
    {
      return lower_;
    }

    /// The smallest one with which it did not, 0 if there is none.
    double
    upper() const
    {
      return upper_;
    }

    /// Share of the load below which a load step is not cut but the soil said
    /// to fail.
    double
    smallest_step() const
    {
      return smallest_step_;
    }

    /// Whether the strength of the seabed is divided, too.
    bool
    includes_seabed() const
    {
      return includes_seabed_;
    }

  private:
    // Parameters
    double first_           = 1.;
    double tolerance_       = 0.005;
    double largest_         = 100.;
    double smallest_        = 0.01;
    double smallest_step_   = 0.1;
    bool   includes_seabed_ = true;

    double lower_ = 0, upper_ = 0;
  };
} // namespace talus

#endif
