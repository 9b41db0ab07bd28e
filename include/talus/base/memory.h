// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_memory_h
#define talus_base_memory_h

#include <deal.II/base/mpi.h>

namespace talus
{
  /// Bytes that each rank can have at most: an equal part of the memory of its
  /// machine, or what is left if the user's shell or a queue has set a limit
  /// (ulimit -v); that of the rank that can have least. Collective.
  double
  memory_per_rank(MPI_Comm communicator);
} // namespace talus

#endif
