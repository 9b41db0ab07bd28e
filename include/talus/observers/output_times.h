// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_output_times_h
#define talus_observers_output_times_h

#include <cmath>

namespace talus
{
  /// Output is due at the first step whose time reaches k times the interval,
  /// k = 1, 2, ...; the time step is not altered to hit these times. Which
  /// multiple is next follows from the time alone, without any tolerance, so
  /// it is the same after a restart, and times do not drift.
  class OutputTimes
  {
  public:
    /// Output was just made at @p time; the next is due one @p interval (both
    /// s) or less later.
    void
    begin(const double interval, const double time)
    {
      interval_ = interval;
      advance(time);
    }

    /// True, once, when @p time has reached the next output time. A step that
    /// passes several of them counts once.
    bool
    reached(const double time)
    {
      if (!(time >= next_ * interval_))
        return false;
      advance(time);
      return true;
    }

  private:
    /// Go to the smallest multiple beyond @p time.
    void
    advance(const double time)
    {
      next_ = std::floor(time / interval_);
      // The quotient is rounded: one to either side may be right.
      while (next_ * interval_ > time)
        --next_;
      while (next_ * interval_ <= time)
        ++next_;
    }

    double interval_ = 1.; // s
    double next_     = 1.; // a whole number
  };
} // namespace talus

#endif
