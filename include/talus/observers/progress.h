// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_progress_h
#define talus_observers_progress_h

#include <talus/io/log.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>

namespace talus
{
  /// Tells how far the simulation is and how fast: lines on the terminal, and
  /// one line with the throughput at the end, which is printed also where
  /// standard output is no terminal.
  class Progress
  {
  public:
    explicit Progress(std::ostream &out         = std::cout,
                      bool          is_terminal = stdout_is_terminal());

    /// Start the clock at simulated time @p time, on the way to @p end_time, s.
    void
    begin(double time, double end_time, MPI_Comm communicator);

    /// To be called after each step, with the number of this rank's points.
    void
    count_step(const unsigned int n_points)
    {
      ++now_.steps;
      now_.point_steps += n_points;
    }

    /// Time, share of the end time, steps and point-steps per second since the
    /// line before, time left at that pace, points. Nothing unless on a
    /// terminal; collective.
    void
    print_line(double time, unsigned int n_points);

    /// The throughput. Collective.
    void
    finish(double time, unsigned int n_points);

  private:
    using Clock = std::chrono::steady_clock;

    struct Count
    {
      Clock::time_point wall_time;
      double            time        = 0; // simulated, s
      double            steps       = 0;
      double            point_steps = 0; // of this rank
    };

    std::ostream &out_;
    const bool    is_terminal_;
    MPI_Comm      communicator_ = MPI_COMM_SELF;
    double        end_time_     = 0; // s
    Count         start_;
    Count         line_before_;
    Count         now_;
  };
} // namespace talus

#endif
