// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_progress_h
#define talus_observers_progress_h

#include <talus/io/log.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>

namespace talus
{
  /// Progress and speed of the run: lines on the terminal, and a final line
  /// with the throughput, printed even if standard output is no terminal.
  class Progress
  {
  public:
    explicit Progress(std::ostream &out         = std::cout,
                      bool          is_terminal = stdout_is_terminal());

    /// Start the clock at simulated time @p time, s; the run ends at
    /// @p end_time, s.
    void
    begin(double time, double end_time, MPI_Comm communicator);

    /// Count a step with @p n_points points on the local rank. Call after each
    /// step.
    void
    count_step(const unsigned int n_points)
    {
      ++now_.steps;
      now_.point_steps += n_points;
    }

    /// Number of steps since begin().
    double
    n_steps() const
    {
      return now_.steps;
    }

    /// Sum over the steps of the points on the local rank.
    double
    n_point_steps() const
    {
      return now_.point_steps;
    }

    /// Print time, share of the end time, steps and point-steps per second
    /// since the previous line, remaining wall time at the current pace, and
    /// number of points. Prints only on a terminal. Collective.
    void
    print_line(double time, unsigned int n_points);

    /// Print the throughput. Collective.
    void
    finish(double time, unsigned int n_points);

  private:
    using Clock = std::chrono::steady_clock;

    struct Count
    {
      Clock::time_point wall_time;
      double            time        = 0; // simulated, s
      double            steps       = 0;
      double            point_steps = 0; // on the local rank
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
