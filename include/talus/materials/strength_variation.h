// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_strength_variation_h
#define talus_materials_strength_variation_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Random variation of a strength in space, as given by the user: the
  /// parameters of a lognormal random field of mean 1.
  class StrengthVariation
  {
  public:
    /// Declare the parameters in a subsection of @p section.
    void
    add_parameters(dealii::ParameterAcceptor &section);

    /// Throw ExcUser unless there is a positive correlation length for each of
    /// @p dim axes, or a single length for all axes. @p section names the
    /// material in messages.
    void
    check(unsigned int dim, const std::string &section) const;

    /// Return whether the strength varies at random.
    bool
    is_active() const
    {
      return coefficient_ > 0.;
    }

    /// Coefficient of variation: standard deviation over mean [-].
    double
    coefficient() const
    {
      return coefficient_;
    }

    /// Correlation length along @p axis, m.
    double
    correlation_length(const unsigned int axis) const
    {
      return lengths_.size() == 1 ? lengths_.front() : lengths_[axis];
    }

    /// Twice the smoothness nu of the Matern correlation: 1, 3 or 5. The
    /// exponential correlation is the one with nu = 1/2.
    unsigned int
    twice_smoothness() const;

    /// Number that selects one realization of the field.
    unsigned int
    seed() const
    {
      return seed_;
    }

  private:
    double              coefficient_ = 0.;
    std::vector<double> lengths_;
    std::string         kernel_ = "exponential";
    unsigned int        seed_   = 1;
  };
} // namespace talus

#endif
