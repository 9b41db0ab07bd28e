// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_undrained_strength_h
#define talus_materials_undrained_strength_h

#include <optional>
#include <string>

namespace talus
{
  /// The undrained shear strength of undisturbed soil as the user gives it: a
  /// number, which goes for all points, or what says it for each of them.
  class UndrainedStrength
  {
  public:
    explicit UndrainedStrength(const std::string &words)
      : words_(words)
    {}

    /// The entry of the parameter file.
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

    /// The number, Pa, if it is one.
    const std::optional<double> &
    number() const;

    /// The file, if it is a table; else empty.
    std::string
    table() const;

    bool
    is_number() const
    {
      return number().has_value();
    }

    /// The number; 1 Pa if the strength stands in a column of the points.
    double
    of_flow_rule() const
    {
      return number().value_or(1.);
    }

  private:
    std::string words_;
    // What they mean, found when it is first asked for.
    mutable std::string           understood_;
    mutable std::optional<double> number_;
  };



  /// The least and the largest undrained shear strength of some soil, Pa.
  struct StrengthRange
  {
    double least, largest;
  };
} // namespace talus

#endif
