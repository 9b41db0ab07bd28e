// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_phase_times_h
#define talus_observers_phase_times_h

#include <talus/base/phase_timer.h>

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
} // namespace talus

#endif
