// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/materials/undrained_strength.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace talus
{
  // Laws call number() in each step, hence the cache.
  const std::optional<double> &
  UndrainedStrength::number() const
  {
    if (understood_ != words_)
      {
        number_.reset();
        if (dealii::Patterns::Double().match(words_))
          number_ = dealii::Utilities::string_to_double(words_);
        understood_ = words_;
      }
    return number_;
  }



  std::string
  UndrainedStrength::table() const
  {
    const std::string keyword = "table ";
    return words_.rfind(keyword, 0) == 0
             ? dealii::Utilities::trim(words_.substr(keyword.size()))
             : "";
  }
} // namespace talus
