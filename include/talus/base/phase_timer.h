// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_phase_timer_h
#define talus_base_phase_timer_h

#include <chrono>
#include <map>
#include <string>

namespace talus
{
  /// Wall times of the phases of a run. deal.II's TimerOutput queries processor
  /// times at the begin and end of each section, which takes some per cent of a
  /// step on a small mesh.
  class PhaseTimer
  {
  public:
    /// Adds the lifetime of the object to the time of a phase.
    class Scope
    {
    public:
      Scope(PhaseTimer &timer, const std::string &phase)
        : time_of_phase_(timer.times_[phase])
        , begin_(Clock::now())
      {}

      Scope(const Scope &) = delete;

      ~Scope()
      {
        time_of_phase_ += Clock::now() - begin_;
      }

    private:
      std::chrono::steady_clock::duration  &time_of_phase_;
      std::chrono::steady_clock::time_point begin_;
    };

    /// Phases executed in turn for every batch of a sweep over the points.
    enum Lap
    {
      time_step,
      points_to_grid,
      grid_to_points,
      stress_update,
      splitting,
      n_laps
    };

    void
    start_laps()
    {
      last_ = Clock::now();
    }

    /// Add the time since start_laps() or the last lap() to @p phase.
    void
    lap(const Lap phase)
    {
      const auto now = Clock::now();
      laps_[phase] += now - last_;
      last_ = now;
    }

    /// Wall times of all phases by name, s; the phases are identical on all
    /// ranks.
    std::map<std::string, double>
    seconds() const
    {
      const char *const names[n_laps] = {"time step",
                                         "points to grid",
                                         "grid to points",
                                         "stress update",
                                         "splitting"};
      using Seconds                   = std::chrono::duration<double>;
      std::map<std::string, double> result;
      for (const auto &[phase, time] : times_)
        result[phase] = Seconds(time).count();
      for (unsigned int i = 0; i < n_laps; ++i)
        result[names[i]] += Seconds(laps_[i]).count();
      return result;
    }

  private:
    using Clock = std::chrono::steady_clock;

    std::map<std::string, Clock::duration> times_;
    Clock::time_point                      last_;
    Clock::duration                        laps_[n_laps] = {};
  };
} // namespace talus

#endif
