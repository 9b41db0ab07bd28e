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
    unsigned int n_steps = 0;  ///< that were measured
    double       seconds = 0.; ///< of one of them on the slowest rank, s
  };

  /// Measure up to ten steps, or those of a fifth of a second, after one that is
  /// not measured. @p step makes one and returns whether there may be another.
  /// Collective.
  Pace
  measure_pace(const std::function<bool()> &step, MPI_Comm communicator);

  /// Return the sentence that says how long @p n_steps steps of @p n_points points
  /// take at this pace, and what memory the ranks have taken so far. Collective.
  std::string
  estimate(const Pace &pace,
           double      n_steps,
           double      n_points,
           MPI_Comm    communicator);
} // namespace talus

#endif
