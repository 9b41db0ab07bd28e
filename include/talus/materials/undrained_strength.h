// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_undrained_strength_h
#define talus_materials_undrained_strength_h

#include <talus/materials/strength_variation.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace talus
{
  /// Undrained shear strength of undisturbed soil as given by the user: a
  /// number for all points, an expression, or a table; times a random field.
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
    std::optional<double>
    number() const;

    /// Random field by which the strength is multiplied.
    StrengthVariation &
    variation()
    {
      return variation_;
    }
    const StrengthVariation &
    variation() const
    {
      return variation_;
    }

    /// Strength of all points, Pa, if it is the same.
    std::optional<double>
    uniform() const
    {
      return variation_.is_active() ? std::nullopt : number();
    }

  private:
    std::string       words_;
    StrengthVariation variation_;
  };



  /// Smallest and largest undrained shear strength of some soil, Pa.
  struct StrengthRange
  {
    double least = std::numeric_limits<double>::infinity(), largest = 0.;

    void
    include(const double strength)
    {
      least   = std::min(least, strength);
      largest = std::max(largest, strength);
    }
  };
} // namespace talus

#endif
