// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_memory_h
#define talus_base_memory_h

#include <deal.II/base/mpi.h>

namespace talus
{
  /// Maximum memory per rank, bytes: an equal part of the memory of the
  /// machine, or the rest of a limit set by the shell or a queue (ulimit -v);
  /// minimum over all ranks. Collective.
  double
  memory_per_rank(MPI_Comm communicator);
} // namespace talus

#endif
