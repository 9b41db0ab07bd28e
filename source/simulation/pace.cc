// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/pace.h>

#include <deal.II/base/timer.h>
#include <deal.II/base/utilities.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  // The first step is not measured, because caches and pages are still cold.
  Pace
  measure_pace(const std::function<bool()> &step, const MPI_Comm communicator)
  {
    bool  goes_on = step();
    Pace  pace;
    Timer timer(communicator, /*sync_lap_times=*/true);
    while (goes_on && pace.n_steps < 10 &&
           Utilities::MPI::max(timer.wall_time(), communicator) < 0.2)
      {
        goes_on = step();
        ++pace.n_steps;
      }
    timer.stop();
    // A run of a single step has no measured step.
    if (pace.n_steps > 0)
      pace.seconds =
        Utilities::MPI::max(timer.wall_time(), communicator) / pace.n_steps;
    return pace;
  }



  namespace
  {
    /// Format a time in a readable unit with two digits.
    std::string
    duration(const double seconds)
    {
      const auto in = [seconds](const double unit, const char *name) {
        return text(std::setprecision(2), std::max(seconds / unit, 0.1), name);
      };
      return seconds < 100      ? in(1., " s")
             : seconds < 6000   ? in(60., " min")
             : seconds < 360000 ? in(3600., " h")
                                : in(86400., " days");
    }
  } // namespace



  std::string
  estimate(const Pace    &pace,
           const double   n_steps,
           const double   n_points,
           const MPI_Comm communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    const double peak = Utilities::MPI::max(memory.VmHWM / 1024., communicator);
    return text(
      "The run will take about ",
      std::setprecision(3),
      std::ceil(n_steps),
      n_steps <= 1. ? " time step" : " time steps",
      pace.n_steps == 0 ? ""
                        : text(", which on ",
                               counted(n_ranks, "rank"),
                               " of this machine, as busy as it is now, take ",
                               duration(n_steps * pace.seconds),
                               " (",
                               std::setprecision(2),
                               1e-6 * n_points / pace.seconds,
                               " million point-steps per second, measured in ",
                               pace.n_steps,
                               " steps)"),
      ", and ",
      std::setprecision(3),
      peak,
      " MB of memory on each rank; more if points are split or steps become "
      "shorter. Output and static stages come on top.");
  }
} // namespace talus
