// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/observers/progress.h>

#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
    double
    seconds(const std::chrono::steady_clock::duration duration)
    {
      return std::chrono::duration<double>(duration).count();
    }



    /// Format a time as 3:07 or 2:03:07; "?" for NaN or more than 115 days.
    std::string
    clock_time(const double seconds)
    {
      if (!(seconds < 1e7))
        return "?";
      const long         whole = std::lround(seconds);
      std::ostringstream out;
      out << std::setfill('0');
      if (whole >= 3600)
        out << whole / 3600 << ':' << std::setw(2);
      out << whole / 60 % 60 << ':' << std::setw(2) << whole % 60;
      return out.str();
    }
  } // namespace



  Progress::Progress(std::ostream &out, const bool is_terminal)
    : out_(out)
    , is_terminal_(is_terminal)
  {}



  void
  Progress::begin(const double   time,
                  const double   end_time,
                  const MPI_Comm communicator)
  {
    communicator_ = communicator;
    end_time_     = end_time;
    now_          = {Clock::now(), time, 0, 0};
    start_ = line_before_ = now_;
  }



  /// Speed and remaining time refer to the interval since the previous line,
  /// not since the start: steps take longer as points split. All ranks must
  /// take part in the sums before the first rank decides whether to print.
  void
  Progress::print_line(const double time, const unsigned int n_points)
  {
    now_.wall_time = Clock::now();
    now_.time      = time;
    const double point_steps =
      Utilities::MPI::sum(now_.point_steps - line_before_.point_steps,
                          communicator_);
    const unsigned long all_points =
      Utilities::MPI::sum(static_cast<unsigned long>(n_points), communicator_);
    // Pace: wall seconds per simulated second, for any time step.
    const double elapsed = seconds(now_.wall_time - line_before_.wall_time);
    const double pace    = elapsed / (now_.time - line_before_.time);
    const double steps   = now_.steps - line_before_.steps;
    line_before_         = now_;
    if (!is_terminal_ || !is_first_rank(communicator_) || steps == 0)
      return;

    std::ostringstream line;
    line << std::fixed << "t = " << std::setprecision(3) << std::setw(9) << time
         << " s " << std::setprecision(0) << std::setw(4)
         << 100. * time / end_time_ << " %" << std::setprecision(1)
         << std::setw(10) << steps / elapsed << " steps/s"
         << std::setprecision(2) << std::setw(8) << 1e-6 * point_steps / elapsed
         << " million point-steps/s" << std::setw(10)
         << clock_time(std::max(end_time_ - time, 0.) * pace) << " left"
         << std::setw(10) << all_points << " points";
    out_ << line.str() << std::endl;
  }



  /// The throughput covers everything since begin(), including output and
  /// static stages.
  void
  Progress::finish(const double time, const unsigned int n_points)
  {
    const double elapsed = seconds(Clock::now() - start_.wall_time);
    const double point_steps =
      Utilities::MPI::sum(now_.point_steps, communicator_);
    const unsigned long all_points =
      Utilities::MPI::sum(static_cast<unsigned long>(n_points), communicator_);
    if (is_first_rank(communicator_))
      out_ << text(std::setprecision(6),
                   static_cast<unsigned long>(now_.steps),
                   " steps to t = ",
                   time,
                   " s, ",
                   all_points,
                   " points at the end, ",
                   std::setprecision(4),
                   point_steps,
                   " point-steps in ",
                   elapsed,
                   " s: ",
                   1e-6 * point_steps / elapsed,
                   " million point-steps per second.")
           << std::endl;
  }
} // namespace talus
