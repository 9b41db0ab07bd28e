// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/materials/undrained_strength.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace talus
{
  std::optional<double>
  UndrainedStrength::number() const
  {
    if (!dealii::Patterns::Double().match(words_))
      return {};
    return dealii::Utilities::string_to_double(words_);
  }
} // namespace talus
