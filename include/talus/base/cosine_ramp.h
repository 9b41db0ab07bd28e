// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_cosine_ramp_h
#define talus_base_cosine_ramp_h

#include <deal.II/base/numbers.h>

#include <cmath>

namespace talus
{
  /// Change over a time, smoothly by half a cosine.
  struct CosineRamp
  {
    double start_time = 0.; ///< s
    double duration   = 0.; ///< s

    /// Progress at time @p t, s: 0 before the start, 1 after the end [-].
    /// Without duration, a jump in the first step that ends after the start.
    double
    progress(const double t) const
    {
      if (t <= start_time)
        return 0.;
      if (t >= end_time())
        return 1.;
      return 0.5 *
             (1. - std::cos(dealii::numbers::PI * (t - start_time) / duration));
    }

    double
    end_time() const
    {
      return start_time + duration;
    }
  };
} // namespace talus

#endif
