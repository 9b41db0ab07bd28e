// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_mpi_setup_h
#define talus_base_mpi_setup_h

#include <cstdlib>

namespace talus
{
  /// Set options of Open MPI, unless the user has set them. Call before
  /// MPI_Init. Other MPI libraries ignore the options.
  ///
  /// Files are written by ROMIO. The MPI-IO of Open MPI protects an open file
  /// by a semaphore named after the file without its folder. The semaphore
  /// survives a killed program: all later checkpoints on the machine would wait
  /// for ever.
  ///
  /// A program without a launcher has one rank and need not search for
  /// networks, which takes 0.2 s. (Open MPI also starts a daemon for the
  /// program. Without the daemon several programs at a time would use the same
  /// names of folders and shared memory.)
  inline void
  prepare_mpi()
  {
    constexpr int keep = 0;
    setenv("OMPI_MCA_io", "^ompio", keep);
    for (const char *launched :
         {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (std::getenv(launched) != nullptr)
        return;
    setenv("OMPI_MCA_pml", "ob1", keep);
  }
} // namespace talus

#endif
