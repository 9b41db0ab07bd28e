// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_pace_h
#define talus_simulation_pace_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

namespace talus
{
  /// Wall time of the first time steps of a run.
  struct Pace
  {
    unsigned int n_steps = 0;  ///< number of measured steps
    double       seconds = 0.; ///< per step on the slowest rank, s
  };

  /// Measure up to ten steps, or about 0.2 s, after an unmeasured first step.
  /// @p step performs a time step and returns whether the run continues.
  /// Collective.
  Pace
  measure_pace(const std::function<bool()> &step, MPI_Comm communicator);

  /// Sentence with the estimated wall time and memory of a run, for the log.
  /// Collective.
  ///
  /// @param pace of the measured steps
  /// @param n_steps number of time steps of the run
  /// @param n_points number of points on all ranks
  /// @param communicator of the run
  std::string
  estimate(const Pace &pace,
           double      n_steps,
           double      n_points,
           MPI_Comm    communicator);
} // namespace talus

#endif
