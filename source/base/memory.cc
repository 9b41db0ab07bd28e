// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/memory.h>

#include <algorithm>

#include <sys/resource.h>
#include <unistd.h>

namespace talus
{
  double
  largest_memory()
  {
    double largest = 1. * sysconf(_SC_PHYS_PAGES) * sysconf(_SC_PAGESIZE);
    rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      largest = std::min(largest, 1. * limit.rlim_cur);
    return largest;
  }
} // namespace talus
