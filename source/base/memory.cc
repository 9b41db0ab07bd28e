// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/memory.h>

#include <algorithm>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

namespace talus
{
  namespace
  {
    /// Address space used by the process with its libraries, bytes; 0 if the
    /// system does not provide the number.
    double
    taken_addresses()
    {
      std::ifstream file("/proc/self/statm");
      double        pages = 0;
      file >> pages;
      return pages * sysconf(_SC_PAGESIZE);
    }



    unsigned int
    n_ranks_on_this_machine(const MPI_Comm communicator)
    {
      MPI_Comm machine;
      int      n_ranks = 1;
      MPI_Comm_split_type(
        communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
      MPI_Comm_size(machine, &n_ranks);
      MPI_Comm_free(&machine);
      return n_ranks;
    }
  } // namespace



  // A limit on addresses includes libraries, about 0.5 GB.
  double
  memory_per_rank(const MPI_Comm communicator)
  {
    double largest = 1. * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE) /
                     n_ranks_on_this_machine(communicator);
    rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      largest =
        std::min(largest, std::max(0., limit.rlim_cur - taken_addresses()));
    return dealii::Utilities::MPI::min(largest, communicator);
  }
} // namespace talus
