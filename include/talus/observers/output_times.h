// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_output_times_h
#define talus_observers_output_times_h

#include <cmath>

namespace talus
{
  /// Output times k * interval, k = 1, 2, ...: output is due at the first step
  /// that reaches an output time; the time step is not adjusted. The next
  /// multiple follows from the time alone, without any tolerance: a restart
  /// does not change the output times, and rounding errors do not accumulate.
  class OutputTimes
  {
  public:
    /// Start after an output at @p time, s; the next output is due after at
    /// most @p interval, s. Without an interval, 0, no output is ever due.
    void
    begin(const double interval, const double time)
    {
      interval_ = interval;
      advance(time);
    }

    /// Return true, once, when @p time has reached the next output time. A step
    /// that passes several output times counts once.
    bool
    reached(const double time)
    {
      if (!(time >= next_ * interval_))
        return false;
      advance(time);
      return true;
    }

  private:
    /// Set the next output time to the smallest multiple beyond @p time.
    void
    advance(const double time)
    {
      next_ = std::floor(time / interval_);
      // The quotient is rounded: the correct multiple may be one lower or
      // higher.
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
