// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_undrained_strength_h
#define talus_materials_undrained_strength_h

#include <optional>
#include <string>

namespace talus
{
  /// Undrained shear strength of undisturbed soil as given by the user: a
  /// number for all points, an expression, or a table.
  class UndrainedStrength
  {
  public:
    explicit UndrainedStrength(const std::string &words)
      : words_(words)
    {}

    /// Entry of the parameter file.
    std::string &
    words()
    {
      return words_;
    }
    const std::string &
    words() const
    {
      return words_;
    }

    /// Value of the entry, Pa, if it is a number.
    const std::optional<double> &
    number() const;

    /// File name if the entry is a table; otherwise empty.
    std::string
    table() const;

    bool
    is_number() const
    {
      return number().has_value();
    }

    /// Strength for the flow rule, Pa: the number, or 1 if a column has the
    /// strength.
    double
    of_flow_rule() const
    {
      return number().value_or(1.);
    }

  private:
    std::string words_;
    // Meaning of words_, cached by number().
    mutable std::string           understood_;
    mutable std::optional<double> number_;
  };



  /// Smallest and largest undrained shear strength of some soil, Pa.
  struct StrengthRange
  {
    double least, largest;
  };
} // namespace talus

#endif
