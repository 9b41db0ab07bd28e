// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_phase_times_h
#define talus_observers_phase_times_h

#include <talus/base/phase_timer.h>
#include <talus/grid/node_numbering.h>
#include <talus/observers/progress.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace talus
{
  /// Report lines with the wall time of each phase (minimum, mean and maximum
  /// over the ranks; share of the mean in the total) and with the peak memory.
  /// Collective; the lines are valid on all ranks.
  std::vector<std::string>
  phase_times(const PhaseTimer &timer, MPI_Comm communicator);

  /// Report lines that tell why a run is slow: number of point-steps, time of
  /// a point-step, imbalance, and messages between the ranks. Collective; the
  /// lines are valid on all ranks.
  std::vector<std::string>
  work_of_ranks(const PhaseTimer &timer,
                const Progress   &progress,
                const SentByRank &sent,
                MPI_Comm          communicator);
} // namespace talus

#endif
