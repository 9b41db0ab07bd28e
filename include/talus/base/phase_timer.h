#ifndef talus_base_phase_timer_h
#define talus_base_phase_timer_h

#include <deal.II/base/timer.h>

#include <array>
#include <chrono>
#include <iostream>
#include <map>
#include <string>

namespace talus
{
  /// Wall time of the phases of a run: sections, as deal.II times them, and
  /// laps within the sweeps over the points, which take turns for every batch
  /// and are too short for a section.
  class PhaseTimer : public dealii::TimerOutput
  {
  public:
    enum Lap
    {
      time_step,
      points_to_grid,
      grid_to_points,
      stress_update,
      splitting,
      n_laps
    };

    PhaseTimer()
      : dealii::TimerOutput(std::cout, never, wall_times)
    {}

    void
    start_laps()
    {
      last_ = Clock::now();
    }

    /// The time since start_laps() or the last lap was spent in this phase.
    void
    lap(const Lap phase)
    {
      const auto now = Clock::now();
      laps_[phase] += now - last_;
      last_ = now;
    }

    /// Phases by name with their wall time, s: the same phases on all ranks.
    std::map<std::string, double>
    seconds() const
    {
      static const std::array<std::string, n_laps> names = {
        {"time step",
         "points to grid",
         "grid to points",
         "stress update",
         "splitting"}};
      auto result = get_summary_data(total_wall_time);
      for (unsigned int i = 0; i < n_laps; ++i)
        result[names[i]] += std::chrono::duration<double>(laps_[i]).count();
      return result;
    }

  private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point                   last_;
    std::array<Clock::duration, n_laps> laps_{};
  };
} // namespace talus

#endif
