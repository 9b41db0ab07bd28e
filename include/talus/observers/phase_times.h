// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_phase_times_h
#define talus_observers_phase_times_h

#include <talus/base/phase_timer.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace talus
{
  /// The wall time of each phase, one line each: least, mean and
  /// largest over the ranks, and the mean's share of all; and the peak memory.
  /// Collective; the lines are right on all ranks.
  std::vector<std::string>
  phase_times(const PhaseTimer &timer, MPI_Comm communicator);
} // namespace talus

#endif
